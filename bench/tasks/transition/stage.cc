#include "bench/tasks/transition/stage.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bench/metrics/transition_smoothness.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/judged_proportions.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

bool IsAct(const LibraryClip& clip) {
  const std::vector<std::string> acts = BuiltinActNames();
  return std::ranges::any_of(acts, [&](const std::string& act) { return clip.source == "builtin:" + act; });
}

void CastClips(const ClipLibrary& library, bool asks_for_acts, Stage& stage) {
  for (int clip = 0; clip < static_cast<int>(library.clips.size()); ++clip) {
    (asks_for_acts && IsAct(library.clips[clip]) ? stage.wanted : stage.playing).push_back(clip);
  }
  if (!stage.wanted.empty() && !stage.playing.empty()) return;
  stage.playing.resize(library.clips.size());
  std::iota(stage.playing.begin(), stage.playing.end(), 0);
  stage.wanted = stage.playing;
}

}  // namespace

std::vector<double> NaturalJumpsOf(const Stage& stage, int from, int to) {
  std::vector<double> jumps = stage.natural_jumps_cm[from];
  jumps.insert(jumps.end(), stage.natural_jumps_cm[to].begin(), stage.natural_jumps_cm[to].end());
  return jumps;
}

double CalmerLimitCm(const Stage& stage, int from, int to) {
  return std::min(NaturalLimitCm(stage.natural_jumps_cm[from]), NaturalLimitCm(stage.natural_jumps_cm[to]));
}

Stage SetStage(const ClipLibrary& library, const StageRules& rules) {
  // Retarget all clips to one body, and tag them.
  Stage stage;
  stage.fuzzy = rules.fuzzy;
  std::vector<std::string> names;
  std::vector<BodyMotion> clips;
  for (const LibraryClip& clip : library.clips) {
    names.push_back(clip.name);
    stage.identities.push_back(clip.source);
    clips.push_back(clip.motion);
  }
  const TagRules tags{.memberships = rules.fuzzy.memberships,
                      .head = rules.head,
                      .min_clips = rules.min_clips,
                      .most_per_class = rules.most_per_class,
                      .weights = rules.fuzzy.weights};
  stage.library = MakeLibrary(std::move(names), clips, JudgedProportions(), tags, rules.tween);
  // Measure each clip's own jumps and foot slide, with which transitions are compared.
  for (const BodyMotion& motion : stage.library.motions) {
    stage.natural_jumps_cm.push_back(NaturalJumpsCm(motion));
    const int last = static_cast<int>(motion.poses.size()) - 1;
    stage.natural_slides_cmps.push_back(last > 0 ? FootSlideCmps(motion.poses, 0, last, motion.rate_hz) : 0);
  }
  stage.real_frames = RealFrames(stage.library.motions);
  CastClips(library, rules.asks_for_acts, stage);
  return stage;
}

}  // namespace etude
