#pragma once

#include <span>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/world.h"

namespace etude {

/// The number of entries of a trace that curves show.
constexpr int kLongestCurve = 200;

/// Makes the curves, of at most 200 entries, of `position_error_max_cm` and `orientation_error_max_deg`, the worst of
/// the effectors.
std::vector<Series> WorstErrorCurves(std::span<const IkTraceEntry> trace);

/// Makes the curves of the same entries, effector by effector: `right_foot_position_error_cm`,
/// `right_foot_x_axis_error_deg`, … (paper B, figure 5.2).
std::vector<Series> EffectorCurves(const KinematicTree& tree, std::span<const IkTraceEntry> trace);

/// Measures the effectors' errors, along "effector", before (`start_…`) and after: `position_error_{x,y,z}_cm`,
/// effector minus target along the world's axes, and `orientation_error_{x,y,z}_deg`, the angle between the effector's
/// axis and its target (table 5.1).
std::vector<Series> EffectorErrors(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles);

/// Measures how angles differ, along "angle", in the tree's order: `angle_change_deg`, the solution minus the start,
/// and `angle_error_deg`, minus the truth (table 5.2).
std::vector<Series> AngleChanges(const IkWorld& world, std::span<const double> angles);

}  // namespace etude
