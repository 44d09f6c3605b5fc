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

/// Runs one method in one world and scores it: metrics, digests, the error curves of the first iterations, and what
/// `records` requests. The reason of an unsolved cell says why the solver stopped.
CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, const IkRecords& records);

/// Returns which parts of their targets the effectors of a world must meet: positions, axes or both.
IkTargetParts AskedOf(const IkProblem& problem);

/// The cost that a method reports, and the reason if it failed.
struct IkAccount {
  std::optional<int> iterations, fk_evaluations;  ///< empty if the method does not report them
  int max_steps = 0;
  std::string why_not_met;  ///< the reason if the targets are not met
};

/// Scores the final angles of a solver or of an outside method: metrics, and the series of the final pose that
/// `records` requests. A world is solved if its effectors meet the required parts of their targets and no limit is
/// broken.
CellResult ScoreAngles(const KinematicTree& tree, const IkWorld& world, std::span<const double> angles,
                       std::span<const EffectorError> effector_errors, const IkAccount& account,
                       const IkRecords& records);

/// Scores an answer of an outside method, without curves; a recording has two frames, start and answer. `max_steps` is
/// the limit for its penalised costs.
CellResult ScoreIkAnswer(const KinematicTree& tree, const IkWorld& world, const IkAnswer& answer, int max_steps,
                         const IkRecords& records);

/// Returns the ids of all metrics that a cell reports, each by a value or a reason.
std::vector<std::string> IkMetrics();

/// Returns the value of a metric for a cell without an answer: 0 for solved shares, twice the limit for penalised costs
/// (PAR-2); nothing for others.
std::optional<double> IkValueOfFailure(std::string_view metric, int max_steps);

/// The largest number of trace entries that curves show.
constexpr int kMaxCurveEntries = 200;

/// Returns the curves, of at most 200 entries, of `position_error_max_cm` and `orientation_error_max_deg`, the largest
/// over the effectors.
std::vector<Series> WorstErrorCurves(std::span<const IkTraceEntry> trace);

/// Returns the curves of the same entries for each effector: `right_foot_position_error_cm`,
/// `right_foot_x_axis_error_deg`, … (paper B, figure 5.2).
std::vector<Series> EffectorCurves(const KinematicTree& tree, std::span<const IkTraceEntry> trace);

/// Returns the effectors' errors, along axis "effector", at the start (`start_…`) and at the end:
/// `position_error_{x,y,z}_cm`, effector minus target along the world's axes, and `orientation_error_{x,y,z}_deg`, the
/// angle between the effector's axis and its target (table 5.1).
std::vector<Series> EffectorErrors(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles);

/// Returns differences of angles, along axis "angle", in the tree's order: `angle_change_deg`, the solution minus the
/// start, and `angle_error_deg`, the solution minus the truth (table 5.2).
std::vector<Series> AngleChanges(const IkWorld& world, std::span<const double> angles);

}  // namespace etude
