#include "bench/tasks/transition/tally.h"

#include <vector>

#include "bench/metrics/transition_smoothness.h"
#include "engine/transitions/base/alignment.h"
#include "engine/transitions/choices/pair_rows.h"

namespace etude {

MatchTally TallyMatches(const Stage& stage, const TransitionRequest& request, const Choice& choice,
                        const MatchRules& rules) {
  const TaggedClip &from = stage.library.tagged[request.from], &to = stage.library.tagged[request.to];
  std::vector<int> leaving, entering;
  if (choice.any_frame) {
    const PairRange range = AllowedPairs(stage.library, request, rules);
    leaving = FramesWithin(range.leave);
    entering = FramesWithin({0, range.enter_end - 1});
  } else {
    leaving = BridgeFramesWithin(from, WaitWindow(from, request.request_frame, request.budget_s));
    entering = BridgeFramesWithin(to, EntryWindow(to));
  }
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
