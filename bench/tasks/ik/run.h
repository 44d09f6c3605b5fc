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

/// Runs one method in one world and scores it: metrics, digests, the curves of the first iterations and what else
/// `records` asks for. The reason of a cell that is not solved says why the solver stopped.
CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, const IkRecords& records);

/// The parts that the targets of a world ask for: positions, axes or both.
IkAsked AskedOf(const IkProblem& problem);

/// The account that a method gives of its answer.
struct IkAccount {
  std::optional<int> iterations, fk_evaluations;  ///< empty where it says nothing
  int max_steps = 0;
  std::string why_not_met;  ///< in case the targets are not met
};

/// Scores the final angles of a solver or of a method outside: metrics, and the series of the final pose that `records`
/// asks for. A world is solved when its effectors meet what it asks of them and no limit is broken.
CellResult ScoreAngles(const KinematicTree& tree, const IkWorld& world, std::span<const double> angles,
                       std::span<const EffectorError> effector_errors, const IkAccount& account,
                       const IkRecords& records);

/// Scores an answer of a method outside; no curves, and a recording of two frames, start and answer. `max_steps` is the
/// limit of its cost.
CellResult ScoreIkAnswer(const KinematicTree& tree, const IkWorld& world, const IkAnswer& answer, int max_steps,
                         const IkRecords& records);

/// The ids of all metrics that a cell reports, a value or a reason for each.
std::vector<std::string> IkMetrics();

/// The value of a metric for a cell without an answer (PAR-2): 0 for solved shares, twice the limit for penalised
/// costs.
std::optional<double> IkValueOfFailure(std::string_view metric, int max_steps);

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
