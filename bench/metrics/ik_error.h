#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"

namespace etude {

/// The errors of end effectors at their targets (docs/reference/metrics.md: position_error_cm, position_error_max_cm,
/// orientation_error_deg, …_max_deg, solved_*).
struct IkErrorSummary {
  double position_cm = 0;      ///< mean over the effectors
  double position_max_cm = 0;  ///< the worst effector
  double orientation_deg = 0;  ///< of each effector the mean over its three axes; then the mean over the effectors
  double orientation_max_deg = 0;
  double axis_max_deg = 0;  ///< the worst single axis of any effector
};

/// Sums up the errors of one or more effectors.
IkErrorSummary SummariseIkErrors(std::span<const EffectorError> errors);

/// The targets of a world's effectors, and the bounds by which "solved" is judged.
struct IkAsked {
  bool positions = true;
  bool axes = true;
};

/// All effectors within 0.1 cm, and every axis of theirs within 0.1°.
bool IsSolvedPractically(const IkErrorSummary& errors, const IkAsked& asked = {});
/// All effectors within 10⁻³ cm, and every axis of theirs within 10⁻³°.
bool IsSolvedTightly(const IkErrorSummary& errors, const IkAsked& asked = {});

/// Counts the angles that lie beyond their limits by more than 10⁻⁶ degrees, which is rounding. Both of one size.
int CountLimitViolations(std::span<const double> angles, std::span<const AngleRange> limits);

/// Root mean square over all degrees of freedom of the difference of two poses' angles, degrees; differences count
/// modulo a full turn. `hidden_angle_error_deg` with the truth, `hidden_angle_change_deg` with the start. Both of one
/// size, not empty.
double HiddenAngleDifferenceDeg(std::span<const double> angles, std::span<const double> others);

/// The penalised cost of a solver's work on one world (`iterations_par2`, `fk_evaluations_par2`): what it spent where
/// it solved the world within the limit, else twice the limit. The mean over worlds is PAR-2, the penalised average of
/// solver competitions: it sees unsolved worlds, which a mean over solved ones would reward.
constexpr double PenalisedCost(double spent, double limit, bool solved) {
  return solved && spent <= limit ? spent : 2 * limit;
}

/// The errors of following a motion, frame by frame (docs/reference/metrics.md, Tracking).
struct TrackedFrame {
  IkErrorSummary errors;
  bool keeps_limits = true;
};

/// True if a frame is solved for practical purposes: within 0.1 cm and 0.1° of every axis, all limits kept.
bool IsFrameSolved(const TrackedFrame& frame);

/// `frames_solved` and `frames_solved_tight`: shares of frames. Needs a frame.
double ShareSolvedPractically(std::span<const TrackedFrame> frames);
double ShareSolvedTightly(std::span<const TrackedFrame> frames);

/// `iterations_per_frame` and `iterations_per_frame_p95`. Needs a frame.
struct FrameIterations {
  double mean = 0;
  double p95 = 0;
};
FrameIterations SummariseIterations(std::span<const int> iterations);

/// `angle_jerk_ratio`: how much jerkier the angles found are than the true ones, [frame][angle] in radians, as many
/// of one as of the other. Nothing for fewer than four frames, or when the truth stands still but for rounding.
std::optional<double> AngleJerkRatio(std::span<const std::vector<double>> found,
                                     std::span<const std::vector<double>> truth);

}  // namespace etude
