#include "bench/tasks/transition/stage.h"

#include <algorithm>

#include "bench/metrics/seam.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

constexpr double kJudgedHipHeight = 0.90;  // docs/metrics.md

std::string MoveIdentity(const std::string& move) { return "builtin:" + move; }

}  // namespace

std::vector<double> NaturalJumpsOf(const Stage& stage, int from, int to) {
  std::vector<double> jumps = stage.natural_jumps_cm[from];
  jumps.insert(jumps.end(), stage.natural_jumps_cm[to].begin(), stage.natural_jumps_cm[to].end());
  return jumps;
}

Stage SetStage(const ClipLibrary& library) {
  Stage stage;
  stage.character = MakePhysique(PoseOf(Controls{}), kJudgedHipHeight);
  for (const LibraryClip& clip : library.clips) {
    stage.names.push_back(clip.name);
    stage.identities.push_back(clip.move ? MoveIdentity(clip.move->name) : clip.source);
    stage.motions.push_back(PerformedBy(stage.character, clip.motion));
    stage.natural_jumps_cm.push_back(NaturalJumpsCm(stage.motions.back()));
  }
  stage.tagged = TagClips(stage.motions, stage.character.standing_hip_height);
  return stage;
}

Result<Stage> SetTrainingStage(const Stage& stage) {
  Stage training;
  training.character = stage.character;
  const auto add = [&](const std::string& identity, BodyMotion motion) {
    training.names.push_back(identity);
    training.identities.push_back(identity);
    training.motions.push_back(std::move(motion));
  };
  for (const std::string& name : BuiltinMoveNames()) {
    auto move = LoadBuiltinMove(name);
    if (!move) return tl::unexpected(move.error());
    add(MoveIdentity(name), PerformedBy(training.character, move->motion));
  }
  for (std::size_t i = 0; i < stage.motions.size(); ++i) {
    const auto& known = training.identities;
    if (std::find(known.begin(), known.end(), stage.identities[i]) != known.end()) continue;
    add(stage.identities[i], stage.motions[i]);
  }
  training.tagged = TagClips(training.motions, training.character.standing_hip_height);
  return training;
}

}  // namespace etude
