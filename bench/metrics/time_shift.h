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

/// Finds the time shift of an answer, to a fraction of a frame. Its first frame belongs to the truth's first. A frame
/// of the truth is compared with the answer at a shifted time, between frames by the cubic of Catmull and Rom through
/// four of them; the answer may also be moved as a whole, rotation and translation.
///
/// First the whole number of the truth's frames within ±kMaxTimeShift_s that leaves the least mean squared distance.
/// Then Gauss–Newton: the shift at which Σ v · e = 0, where e is the rest after the best movement and v the truth's
/// velocity (central differences) without its own best movement. The truth's velocity, not the answer's, so that noise
/// of the answer does not pull the shift towards half frames. The interval is the jackknife's over ten equal parts of
/// the motion (Student's t), because errors of one frame and the next are alike.
///
/// Nothing if fewer than five frames or three joints are seen by both, if the best shift lies at the end of the range,
/// or if the truth's motion cannot be told from a movement as a whole: it stands, or glides evenly.
std::optional<TimeShift> FindTimeShift(const PointTracks& truth, double truth_rate_hz, const PointTracks& answer,
                                       double answer_rate_hz);

}  // namespace etude
