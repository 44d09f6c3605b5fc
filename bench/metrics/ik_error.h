#pragma once

#include <span>

#include "engine/kinematics/ik_problem.h"

namespace etude {

/// How well end effectors meet their targets (docs/metrics.md: position_error_cm, position_error_max_cm,
/// orientation_error_deg, …_max_deg, solved_*).
struct IkErrorSummary {
  double position_cm = 0;      ///< mean over the effectors
  double position_max_cm = 0;  ///< the worst effector
  double orientation_deg = 0;  ///< of each effector the mean over its three axes; then the mean over the effectors
  double orientation_max_deg = 0;
  double axis_max_deg = 0;  ///< the worst single axis of any effector
};

/// Needs at least one effector.
IkErrorSummary SummariseIkErrors(std::span<const EffectorError> errors);

/// What a world asks of its effectors, and what "solved" is judged by.
struct IkAsked {
  bool positions = true;
  bool axes = true;
};

/// All effectors within 0.1 cm, and every axis of theirs within 0.1°.
bool IsSolvedPractically(const IkErrorSummary& errors, const IkAsked& asked = {});
/// All effectors within 10⁻³ cm, and every axis of theirs within 10⁻³°.
bool IsSolvedTightly(const IkErrorSummary& errors, const IkAsked& asked = {});

/// How many angles lie beyond their limits by more than 10⁻⁶ degrees, which is rounding. Both of one size.
int CountLimitViolations(std::span<const double> angles, std::span<const AngleRange> limits);

/// Root mean square over all degrees of freedom of the difference of two poses' angles, degrees; differences count
/// modulo a full turn. `hidden_angle_error_deg` with the truth, `hidden_angle_change_deg` with the start. Both of one
/// size, not empty.
double HiddenAngleDifferenceDeg(std::span<const double> angles, std::span<const double> others);

}  // namespace etude
