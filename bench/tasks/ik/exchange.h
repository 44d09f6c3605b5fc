#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/world.h"

namespace etude {

/// Describes the condition to outside methods, in the format of tree_json.h.
///
/// The setting holds the body's tree, and the goals at which built-in solvers stop:
///
///     {"joints": […], "angles": […], "effectors": […],
///      "max_steps": 200, "position_goal_cm": 0.1, "orientation_goal_deg": 0.1,
///      "asked": ["position", "orientation"]}
///
/// `asked` lists the parts of the targets that the effectors must reach, one or both; only these are judged.
Payload DescribeIkSetting(const KinematicTree& tree, const IkOptions& options, const IkTrialOptions& trial);

/// Encodes a problem: the root, the start, and the target of each effector in the setting's order:
///
///     {"root": {"position_m": [0, 0, 0], "rotation": [[…], […], […]]},
///      "start_angles_deg": [twenty-nine numbers, all within their limits],
///      "targets": [{"effector": "right_foot", "position_m": [x, y, z], "rotation": [[…], […], […]]}, …]}
///
/// The method must find angles that bring every effector to its target, or to the `asked` part of it. The distance must
/// be below `position_goal_cm`. The angle between each of the effector's three axes (the columns of its rotation) and
/// the same axis of the target must be below `orientation_goal_deg`.
Payload DescribeProblem(const KinematicTree& tree, const IkProblem& problem);

/// Encodes the truth: the angles from which the targets were made. It is a perfect answer unless the scenario disturbs
/// the targets or moves them out of reach.
///
///     {"angles_deg": [twenty-nine numbers]}
Payload DescribeTruth(const IkWorld& world);

/// The answer of an outside method:
///
///     {"angles_deg": [twenty-nine numbers], "iterations": 12, "fk_evaluations": 13}
///
/// `iterations` and `fk_evaluations` are optional; without them the cost metrics are missing. `iterations` counts the
/// method's own steps, `fk_evaluations` its passes of forward kinematics over the whole tree. Angles are never clamped
/// to their limits: an answer that exceeds a limit by more than 10⁻⁶ degrees is measured and counts as unsolved.
struct IkAnswer {
  std::vector<double> angles;  ///< radians
  std::optional<int> iterations;
  std::optional<int> fk_evaluations;
};

/// Reads an answer. Fails if it has the wrong shape, or if an angle exceeds a million degrees.
Result<IkAnswer> ReadIkAnswer(const Json& answer, const KinematicTree& tree);

/// The state of a solver after one iteration, for a film.
struct IkRecordedStep {
  int iteration = 0;
  std::vector<double> angles;
  double position_error_max_cm = 0;
  double orientation_error_max_deg = 0;
  double axis_error_max_deg = 0;  ///< error of the worst single axis, by which "solved" is judged
};

/// Returns the iterations of 0…`last` that a recording shows: all up to 60, then some at growing intervals, and the
/// last; at most 150.
std::vector<int> RecordedIterations(int last);

/// Returns the steps of a trace at the recorded iterations.
std::vector<IkRecordedStep> StepsOf(std::span<const IkTraceEntry> trace);

/// Records a cell: IkExtras and the tracks "truth", "start" and, step by step, "solution".
Recording RecordIk(const KinematicTree& tree, const IkWorld& world, std::span<const IkRecordedStep> steps);

}  // namespace etude
