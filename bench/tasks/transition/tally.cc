#include "bench/tasks/transition/tally.h"

#include "bench/metrics/transition_smoothness.h"
#include "engine/transitions/alignment.h"
#include "engine/transitions/library/transition_points.h"

namespace etude {

MatchTally TallyMatches(const Stage& stage, const TransitionRequest& request, const TransitionWay& way) {
  const TaggedClip &from = stage.library.tagged[request.from], &to = stage.library.tagged[request.to];
  const AllowedFrames allowed = way.choice->allowed(stage.library, request, way.choice_settings);
  MatchTally tally{.pairs = allowed.Pairs()};
  for (int leave : allowed.leave) {
    const BodyPose& left = stage.library.motions[request.from].poses[leave];
    for (int enter : allowed.enter) {
      if (!Matches(from, leave, to, enter, way.rules)) continue;
      ++tally.matching;
      const BodyPose& entered = stage.library.motions[request.to].poses[enter];
      tally.falsely_smooth += IsFalselySmooth(100 * PoseGap(left, entered)) ? 1 : 0;
    }
  }
  return tally;
}

}  // namespace etude
