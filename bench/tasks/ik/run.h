#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/metrics/ik_error.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/exchange.h"
#include "bench/tasks/ik/options.h"
#include "bench/tasks/ik/world.h"

namespace etude {

/// Runs one method in one world and scores it. The result has metrics, digests, the error curves of the first
/// iterations, and the data that `records` requests. The reason of an unsolved cell says why the solver stopped.
CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, const IkRecords& records);

/// Returns the parts of the targets that the effectors of a world must reach: positions, axes or both.
IkTargetParts AskedOf(const IkProblem& problem);

/// The costs that a method reports, and the reason if the method did not reach the targets.
struct IkAccount {
  std::optional<int> iterations, fk_evaluations;  ///< costs; empty if the method does not report them
  int max_steps = 0;
  std::string why_not_met;  ///< why the targets are not met, if they are not
};

/// Scores the final angles of a solver or of an outside method: metrics, and the series of the final pose that
/// `records` requests. A world is solved if its effectors reach the required parts of their targets and no limit is
/// exceeded.
CellResult ScoreAngles(const KinematicTree& tree, const IkWorld& world, std::span<const double> angles,
                       std::span<const EffectorError> effector_errors, const IkAccount& account,
                       const IkRecords& records);

/// Scores an answer of an outside method. There are no curves, and a recording has two frames: start and answer.
/// `max_steps` is the limit for the penalised costs.
CellResult ScoreIkAnswer(const KinematicTree& tree, const IkWorld& world, const IkAnswer& answer, int max_steps,
                         const IkRecords& records);

/// Returns the ids of all metrics that a cell reports, by a value or by the reason why the value is missing.
std::vector<std::string> IkMetrics();

/// Returns the value of a metric for a cell without an answer: 0 for solved shares, twice the limit for penalised costs
/// (PAR-2). Returns nothing for other metrics.
std::optional<double> IkValueOfFailure(std::string_view metric, int max_steps);

/// The largest number of trace entries that curves show.
constexpr int kMaxCurveEntries = 200;

/// Returns the curves `position_error_max_cm` and `orientation_error_max_deg`: the largest error over the effectors,
/// after each iteration. A curve has at most kMaxCurveEntries entries.
std::vector<Series> WorstErrorCurves(std::span<const IkTraceEntry> trace);

/// Returns curves for each effector, after the same iterations as WorstErrorCurves: `right_foot_position_error_cm`,
/// `right_foot_x_axis_error_deg`, … (paper B, figure 5.2).
std::vector<Series> EffectorCurves(const KinematicTree& tree, std::span<const IkTraceEntry> trace);

/// Returns series of the effectors' errors, one value per effector, at the start (`start_…`) and at the end (paper B,
/// table 5.1). `position_error_{x,y,z}_cm` is effector minus target along the world's axes.
/// `orientation_error_{x,y,z}_deg` is the angle between the effector's axis and the target's axis.
std::vector<Series> EffectorErrors(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles);

/// Returns series of differences of angles, one value per angle in the tree's order (paper B, table 5.2):
/// `angle_change_deg` is the solution minus the start, `angle_error_deg` the solution minus the truth.
std::vector<Series> AngleChanges(const IkWorld& world, std::span<const double> angles);

}  // namespace etude
