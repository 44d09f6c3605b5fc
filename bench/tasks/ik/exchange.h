#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/world.h"

namespace etude {

/// Describes inverse kinematics to methods outside the program, in the words of tree_json.h.
///
/// Setting: the body's tree, and what built-in solvers stop at:
///
///     {"joints": […], "angles": […], "effectors": […],
///      "max_steps": 200, "position_goal_cm": 0.1, "orientation_goal_deg": 0.1,
///      "asked": ["position", "orientation"]}
///
/// `asked` is what effectors are to meet of their targets, one of them or both; the answer is judged by that alone.
Payload DescribeIkSetting(const KinematicTree& tree, const IkOptions& options, const IkTrialOptions& trial);

/// Makes a problem: where the root is, where to begin, and where each effector shall be, in the setting's order:
///
///     {"root": {"position_m": [0, 0, 0], "rotation": [[…], […], […]]},
///      "start_angles_deg": [twenty-nine numbers, all within their limits],
///      "targets": [{"effector": "right_foot", "position_m": [x, y, z], "rotation": [[…], […], […]]}, …]}
///
/// Asked for are angles that bring every effector to its target (or to `asked` of it): the distance below
/// `position_goal_cm`, and each of the angles between its three axes (the columns of its rotation) and the target's
/// below `orientation_goal_deg`.
Payload DescribeProblem(const KinematicTree& tree, const IkProblem& problem);

/// Makes the truth: the angles that the targets were made with; itself a perfect answer, unless the scenario disturbs
/// the targets or pulls them out of reach.
///
///     {"angles_deg": [twenty-nine numbers]}
Payload DescribeTruth(const IkWorld& world);

/// The answer of a method outside:
///
///     {"angles_deg": [twenty-nine numbers], "iterations": 12, "fk_evaluations": 13}
///
/// The last two may be left out; the metrics of cost are then missing. `iterations` are the method's own steps,
/// `fk_evaluations` its passes of forward kinematics over the whole tree. Angles are taken as they are, never moved
/// into their limits: an answer that breaks a limit by more than 10⁻⁶ degrees is measured, and counts as unsolved.
struct IkAnswer {
  std::vector<double> angles;  ///< radians
  std::optional<int> iterations;
  std::optional<int> fk_evaluations;
};

/// Reads an answer. Refuses what is not as told above, and angles of more than a million degrees.
Result<IkAnswer> ReadIkAnswer(const Json& answer, const KinematicTree& tree);

/// The state after one iteration, as a film shows it.
struct IkRecordedStep {
  int iteration = 0;
  std::vector<double> angles;
  double position_error_max_cm = 0;
  double orientation_error_max_deg = 0;
  double axis_error_max_deg = 0;  ///< of the worst single axis, which "solved" is judged by
};

/// Chooses which of the iterations 0…`last` a recording shows: every one up to 60, then growing steps up to the last;
/// at most 150.
std::vector<int> RecordedIterations(int last);

/// Picks the steps of a trace at the recorded iterations.
std::vector<IkRecordedStep> StepsOf(std::span<const IkTraceEntry> trace);

/// Records tracks "truth", "start" and, step by step, "solution", and IkExtras.
Recording RecordIk(const KinematicTree& tree, const IkWorld& world, std::span<const IkRecordedStep> steps);

}  // namespace etude
