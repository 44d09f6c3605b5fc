#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"

namespace etude {

/// The errors of end effectors with respect to their targets (docs/reference/metrics.md: position_error_cm,
/// position_error_max_cm, orientation_error_deg, orientation_error_max_deg, solved_practical, solved_tight).
struct IkErrorSummary {
  double position_cm = 0;      ///< mean position error over the effectors
  double position_max_cm = 0;  ///< largest position error of any effector
  double orientation_deg = 0;  ///< mean axis error over the effectors and their three axes
  double orientation_max_deg = 0;
  double axis_max_deg = 0;  ///< the largest error of any axis of any effector
};

/// Summarises the errors of one or more end effectors.
IkErrorSummary SummariseIkErrors(std::span<const EffectorError> errors);

/// The parts of a target that a world prescribes. Only these parts decide if the world is solved.
struct IkTargetParts {
  bool positions = true;
  bool axes = true;
};

/// Returns true if every effector is within 0.1 cm of its target and every axis within 0.1°. Parts not in `asked` are
/// ignored.
bool IsSolvedPractically(const IkErrorSummary& errors, const IkTargetParts& asked = {});
/// Returns true if every effector is within 10⁻³ cm of its target and every axis within 10⁻³°. Parts not in `asked` are
/// ignored.
bool IsSolvedTightly(const IkErrorSummary& errors, const IkTargetParts& asked = {});

/// Counts the angles that exceed their limits by more than 10⁻⁶ degrees; this tolerance allows for rounding. Both spans
/// have the same size.
int CountLimitViolations(std::span<const double> angles, std::span<const AngleRange> limits);

/// Returns the root mean square difference of two poses' angles over all degrees of freedom, degrees. Each difference
/// counts modulo a full turn. Compared with the true pose this is `hidden_angle_error_deg`, with the start pose
/// `hidden_angle_change_deg`. Both spans have the same size and are not empty.
double HiddenAngleDifferenceDeg(std::span<const double> angles, std::span<const double> others);

/// Returns the penalised cost of a solver in one world (`iterations_par2`, `fk_evaluations_par2`): the true cost if the
/// solver solved the world within the limit, else twice the limit. The mean over worlds is PAR-2, the score of solver
/// competitions. A mean over solved worlds alone would ignore the unsolved ones.
constexpr double PenalisedCost(double spent, double limit, bool solved) {
  return solved && spent <= limit ? spent : 2 * limit;
}

/// The errors in one frame of a tracked motion (docs/reference/metrics.md, Tracking).
struct TrackedFrame {
  IkErrorSummary errors;
  bool keeps_limits = true;
};

/// Returns true if a frame is solved for practical purposes: every effector is within 0.1 cm, every axis within 0.1°,
/// and all angles are within their limits.
bool IsFrameSolved(const TrackedFrame& frame);

/// ShareSolvedPractically returns `frames_solved`, ShareSolvedTightly returns `frames_solved_tight`: the share of
/// solved frames. At least one frame is required.
double ShareSolvedPractically(std::span<const TrackedFrame> frames);
double ShareSolvedTightly(std::span<const TrackedFrame> frames);

/// The mean and the 95th percentile of iterations per frame: `iterations_per_frame` and `iterations_per_frame_p95`. At
/// least one frame is required.
struct FrameIterations {
  double mean = 0;
  double p95 = 0;
};
FrameIterations SummariseIterations(std::span<const int> iterations);

/// Returns `angle_jerk_ratio`: the total jerk of the found angles divided by the total jerk of the true angles. Both
/// are [frame][angle], radians, with the same number of frames. Nullopt for fewer than four frames, or if the truth
/// does not move by more than rounding.
std::optional<double> AngleJerkRatio(std::span<const std::vector<double>> found,
                                     std::span<const std::vector<double>> truth);

}  // namespace etude
