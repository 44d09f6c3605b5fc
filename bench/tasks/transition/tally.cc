#include "bench/tasks/transition/tally.h"

#include <algorithm>
#include <numeric>

#include "bench/metrics/seam.h"
#include "engine/bridging/alignment.h"
#include "engine/switching/choices/pair_rows.h"

namespace etude {
namespace {

/// The frames of `window`, or its bridge frames.
std::vector<int> FramesOf(const TaggedClip& clip, FrameWindow window, bool any_frame) {
  std::vector<int> frames;
  if (any_frame) {
    frames.resize(std::max(window.last - window.first + 1, 0));
    std::iota(frames.begin(), frames.end(), window.first);
  } else {
    for (int frame : clip.bridge_frames) {
      if (window.Contains(frame)) frames.push_back(frame);
    }
  }
  return frames;
}

}  // namespace

MatchTally TallyMatches(const Stage& stage, const SwitchRequest& request, const Choice& choice,
                        const SwitchRules& rules) {
  const TaggedClip &from = stage.library.tagged[request.from], &to = stage.library.tagged[request.to];
  PairRange range{WaitWindow(from, request.request_frame, request.budget_s), to.FrameCount() - 1};
  if (choice.any_frame) range = AllowedPairs(stage.library, request, rules);
  const std::vector<int> leaving = FramesOf(from, range.leave, choice.any_frame);
  const std::vector<int> entering = FramesOf(to, {0, range.enter_end - 1}, choice.any_frame);
  MatchTally tally{.pairs = static_cast<std::int64_t>(leaving.size() * entering.size())};
  for (int leave : leaving) {
    const BodyPose& left = stage.library.motions[request.from].poses[leave];
    for (int enter : entering) {
      if (!Matches(from, leave, to, enter, rules)) continue;
      ++tally.matching;
      const BodyPose& entered = stage.library.motions[request.to].poses[enter];
      tally.falsely_smooth += IsFalselySmooth(100 * PoseGap(left, entered)) ? 1 : 0;
    }
  }
  return tally;
}

}  // namespace etude
