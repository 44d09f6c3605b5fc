#pragma once

#include <optional>

#include "bench/metrics/evaluation.h"

namespace etude {

/// The time by which an answer is later than its truth.
struct TimeShift {
  double shift_s = 0;                  ///< the truth at time t corresponds to the answer at t + shift_s
  std::optional<double> half_width_s;  ///< half the width of the 95 % interval; empty if there are too few frames
};

/// The largest time shift that is searched in either direction, seconds.
constexpr double kMaxTimeShift_s = 2;
/// The share of the variance of the answer's distances that the best shift must explain. Other parts of a dance, a
/// dance in reverse, and a still body with noise stay below it. *(ours)*
inline constexpr double kMinExplainedShare = 0.5;

/// Finds the time shift of an answer, to a fraction of a frame, from the distances between its joints. The answer's
/// position, heading and size therefore have no effect, and slightly different joint positions have little effect. If
/// there are more than twenty joints, twenty evenly chosen ones are used. The first frames of answer and truth have
/// time 0. Each frame of the truth is compared with the answer at the shifted time, interpolated by a Catmull-Rom cubic
/// through four frames.
///
/// For each pair of joints, a line α + β s with β ≥ 0 is fitted to the answer's distance f, where s is the true
/// distance.
/// 1. Try every whole number of the truth's frames within ±kMaxTimeShift_s; take the one at which the lines explain
///    most of the variance of f. In a motion that repeats, several shifts fit nearly as well: the variance that they
///    leave unexplained is at most 1.44 times the least. Then start from the smallest of them, and take the best one
///    that is connected with it by such shifts.
/// 2. From there, find by Newton's method the shift at which Σ w β v · (f − α − β s) = 0 over all pairs and frames.
/// Here v is the rate of change of s by central differences, minus its regression on 1 and s. v is computed from the
/// truth, because the noise in the answer's distances would bias the shift towards half frames. w = 1 / (the pair's
/// mean squared residual + 1 mm²), so pairs with a good fit dominate: if the spines differ, these are the pairs within
/// one limb.
///
/// The interval comes from a jackknife over ten equal parts of the motion (Student's t), because the errors of
/// successive frames are correlated. The interval does not include the effect of different joint positions.
///
/// Returns nothing if the numbers of joints differ or are below two, if fewer than five frames are seen in both, if the
/// best shift of step 1 lies at the end of the range or explains less than kMinExplainedShare of the variance, if step
/// 2 does not converge or moves the shift by more than two frames, or if no distance between joints changes because the
/// truth stands still or moves rigidly.
std::optional<TimeShift> FindTimeShift(const PointTracks& truth, double truth_rate_hz, const PointTracks& answer,
                                       double answer_rate_hz);

}  // namespace etude
