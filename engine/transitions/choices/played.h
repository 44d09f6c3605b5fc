#pragma once

#include "engine/base/settings.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

struct PlayedOptions {
  /// The exchange rate of the cost: one second of waiting or blending equals this much acceleration beyond the clips'
  /// own, cm/frame². Smaller: smoother, later, longer transitions.
  double excess_per_s = 0.2;
  /// The exchange rate for poses of neither clip: one second equals so many cm off the nearer clip, integrated over
  /// seconds.
  double invented_per_s = 5;
  double most_skipped_s = 1.5;  ///< how much of the wanted clip may be skipped; never more than its first third
  double most_through_s = 4;    ///< how much of a clip that stands up or lies down may be shown on the way
};
const SettingTable<PlayedOptions>& PlayedSettings();

/// Plays transitions before it takes one. Of the pairs of frames that the budget and `most_skipped_s` allow, sixteen,
/// each the nearest by MotionFeatures for its part of the wait, are joined at several lengths from 0.3 to 1.2 s, as far
/// as the wanted clip goes, both direct and by a fade (PlayMinimumJerk), with their feet (PlantFeet), and the one of
/// least cost is taken: wait + length + the largest acceleration of any joint beyond what either clip has of its own
/// there, and beyond what is usual in the calmer one, 9 m/s² at least (`excess_per_s`) + how far the frames shown are
/// from both clips' own, the root of the mean over joints, summed over time (`invented_per_s`) + a second for each 10 cm
/// that feet slide + 0.1 s for each frame in which no foot bears by FootPlan + 6 s for each frame, beyond two, of the
/// most in a row that FindSupport finds nothing to hold up. Ways are played the cheapest first, as far as they may be
/// the best (PlayWays). The record's last segment holds how it should be joined (PreferredJoin).
///
/// Pairs are left out whose join would raise or lower the body on nothing (NeedsClip). Where no other is allowed, the
/// way leads through the clip that stands up or lies down (FindThroughClip), after the wait; the record has no segments
/// where the library has none.
///
/// Ours; searching what is shown instead of what is alike after Kovar, Gleicher and Pighin 2002 and Bollo 2018. It asks
/// what holds the body up as transitions are judged, and does not know their limits.
TransitionRecord PlanPlayed(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                            const PlayedOptions& options = {});

}  // namespace etude
