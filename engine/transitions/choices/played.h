#pragma once

#include "engine/base/settings.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

struct PlayedOptions {
  /// The excess acceleration, in cm/frame² above the clips' own, that costs as much as one second of waiting or
  /// blending. A smaller value gives smoother, later and longer transitions.
  double excess_per_s = 0.2;
  /// The deviation from the nearer clip's pose, integrated over time (cm·s), that costs as much as one second of
  /// waiting or blending.
  double invented_per_s = 5;
  /// The maximum time at the start of the wanted clip that may be skipped, seconds. At most the first third is ever
  /// skipped.
  double most_skipped_s = 1.5;
  /// The maximum time, seconds, for which an intermediate clip may be shown (a clip in which the person stands up or
  /// lies down).
  double most_through_s = 4;
};
const SettingTable<PlayedOptions>& PlayedSettings();

/// Plays candidate transitions and takes the one with the lowest cost.
///
/// Candidates: the playing clip's frames within the budget are divided into sixteen parts. In each part, the pair
/// with the most similar MotionFeatures is taken; `most_skipped_s` limits the frames of the wanted clip. Each pair is
/// joined at several lengths from 0.3 to 1.2 s; lengths for which the wanted clip is too short are left out, except
/// 0.3 s. For each length there are direct joins and fades (PlayMinimumJerk), with planted feet (PlantFeet); each is
/// placed once by the feet and once where the body's momentum carries it (CarriedShift). The cheapest candidates are
/// played first, and only as long as they may be the best (PlayJoins).
///
/// The cost in seconds is the sum of
/// - the wait and the length of the join;
/// - the largest acceleration of any joint above what either clip has at that time, and above the usual acceleration of
///   the calmer clip, which is taken to be at least 9 m/s² (`excess_per_s`);
/// - the deviation of the shown frames from the nearer clip's frames, as the root mean square over joints, integrated
///   over time (`invented_per_s`);
/// - one second for each 10 cm that feet slide;
/// - 0.1 s for each frame in which no foot carries weight (FootPlan);
/// - 6 s for each frame beyond two in the longest run of frames in which FindSupport finds no support;
/// - 6 s for each 10 cm that the zero-moment point is off the supports for one second (ZeroMomentOffset). Only the part
///   that exceeds 10 cm and the distance in either clip at that time counts, and only while something supports the
///   body;
/// - one second for each centimetre that the slowest support glides farther than a clip's own joint does there;
/// - one second for each 10° that the hips turn against a resting foot, above 30° and above the clips' own turn.
///
/// Pairs are left out if their join would raise or lower the body without support (NeedsClip). If no other pair is
/// allowed, the transition goes, after the wait, through an intermediate clip in which the person stands up or lies
/// down (FindThroughClip); without such a clip in the library the record has no segments. The last segment of the
/// record holds the preferred join (PreferredJoin).
///
/// This choice is ours. It compares the resulting motions instead of the similarity of poses, after Kovar, Gleicher and
/// Pighin 2002 and Bollo 2018. Support is computed as in the evaluation of transitions. Of the evaluation's limits, the
/// choice uses two: at most the first third of the wanted clip is skipped, and more pairs are played if the body is
/// unsupported for four frames in a row.
TransitionRecord PlanPlayed(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                            const PlayedOptions& options = {});

}  // namespace etude
