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

namespace {

bool IsLongEnough(const Stage& stage, int clip) { return stage.library.tagged[clip].FrameCount() >= kMinClipFrames; }

}  // namespace

int FromClip(const Stage& stage, const WorldKey& key) {
  return stage.playing[key.trial % static_cast<int>(stage.playing.size())];
}

Result<TransitionRequest> DrawRequest(const Stage& stage, const WorldKey& key) {
  constexpr int kEarliestRequest = 6;
  const int count = static_cast<int>(stage.library.names.size());
  if (count < 2) return Fail({}, "a transition needs two clips; this library has {}", count);
  TransitionRequest request{.from = FromClip(stage, key)};
  const int frames = stage.library.tagged[request.from].FrameCount();
  if (!IsLongEnough(stage, request.from)) {
    return Fail({}, "clip {} has {} frames; a transition is judged over at least {}", stage.library.names[request.from],
                frames, kMinClipFrames);
  }
  std::vector<int> others;
  for (int clip : stage.wanted) {
    if (clip != request.from && IsLongEnough(stage, clip)) others.push_back(clip);
  }
  if (others.empty()) return Fail({}, "no other clip of this library has at least {} frames", kMinClipFrames);
  // Draw the requested clip and the time of the request.
  request.to = others[RandomStream(key, "to-clip").IndexBelow(others.size())];
  // At least kEarliestRequest frames precede the request, and at least the clip's last frame follows it.
  const int last = frames - 2;
  RandomStream dice(key, "request-time");
  request.request_frame = kEarliestRequest + static_cast<int>(dice.IndexBelow(last - kEarliestRequest + 1));
  return request;
}

}  // namespace etude
