#include "bench/tasks/transition/stage.h"

#include <utility>

#include "bench/metrics/seam.h"
#include "bench/training/training_clips.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

constexpr double kJudgedHipHeight = 0.90;  // docs/metrics.md

}  // namespace

std::vector<double> NaturalJumpsOf(const Stage& stage, int from, int to) {
  std::vector<double> jumps = stage.natural_jumps_cm[from];
  jumps.insert(jumps.end(), stage.natural_jumps_cm[to].begin(), stage.natural_jumps_cm[to].end());
  return jumps;
}

Stage SetStage(const ClipLibrary& library) {
  Stage stage;
  std::vector<std::string> names;
  std::vector<BodyMotion> clips;
  for (const LibraryClip& clip : library.clips) {
    names.push_back(clip.name);
    stage.identities.push_back(clip.move ? MoveIdentity(clip.move->name) : clip.source);
    clips.push_back(clip.motion);
  }
  stage.library = MakeLibrary(std::move(names), clips, MakePhysique(PoseOf(Controls{}), kJudgedHipHeight));
  for (const BodyMotion& motion : stage.library.motions) stage.natural_jumps_cm.push_back(NaturalJumpsCm(motion));
  return stage;
}

}  // namespace etude
