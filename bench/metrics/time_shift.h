#pragma once

#include <optional>

#include "bench/metrics/evaluation.h"

namespace etude {

/// How much later than its truth an answer is.
struct TimeShift {
  double shift_s = 0;                  ///< the truth at time t is the answer at t + shift_s
  std::optional<double> half_width_s;  ///< of its 95 % interval; nothing: too few frames
};

/// The largest shift that is sought, either way.
constexpr double kMaxTimeShift_s = 2;

/// Finds the time shift of an answer, to a fraction of a frame, from the distances between its joints: so neither
/// another place, turn or size of the answer nor joints that lie a little elsewhere pull it. Of more than twenty
/// joints, twenty evenly chosen ones count. The answer's first frame belongs to the truth's first. A frame of the truth
/// is compared with the answer at a shifted time, between frames by the cubic of Catmull and Rom through four of them.
///
/// For each pair of joints the answer's distance f is fitted by α + β s, s: the truth's, β ≥ 0. First the whole number
/// of the truth's frames within ±kMaxTimeShift_s at which these fits explain most of the variance of f. Then Newton's
/// steps to the shift at which Σ w β v · (f − α − β s) = 0 over pairs and frames. v is the truth's rate, of s, by
/// central differences, without what 1 and s explain of it; with the answer's own rate its noise would pull the shift
/// towards half frames. w = 1 / (the pair's mean squared rest + 1 mm²), so that pairs that fit decide, such as those of
/// one limb where a spine differs.
///
/// The interval is the jackknife's over ten equal parts of the motion (Student's t), because errors of one frame and
/// the next are alike. It knows nothing of what joints that lie elsewhere add.
///
/// Nothing if fewer than five frames are seen by both, if the best shift lies at the end of the range, or if no
/// distance changes: the truth stands or glides.
std::optional<TimeShift> FindTimeShift(const PointTracks& truth, double truth_rate_hz, const PointTracks& answer,
                                       double answer_rate_hz);

}  // namespace etude
