#include "bench/tasks/ik/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "bench/tasks/base/tree_json.h"
#include "engine/base/angles.h"
#include "engine/base/digest.h"
#include "engine/kinematics/solvers/ik_run.h"

namespace etude {
namespace {

std::string DigestOf(const IkSolution& solution) {
  Digest digest;
  digest.Add(solution.angles).Add(static_cast<std::int64_t>(solution.iterations));
  return digest.Hex();
}

/// Returns the reason why the solver stopped. Cells that ended in the same way have the same text, so a report can
/// count them.
std::string WhyItStopped(const IkMethod& method, const IkSolution& solution, const IkTargetParts& asked) {
  if (asked.axes && !method.solver->uses_axes) return "the solver uses only positions, but axes are asked for";
  switch (solution.status) {
    case IkStatus::kStalled:
      return "stalled before the targets were met";
    case IkStatus::kUnreachable:
      return "a target is out of reach";
    case IkStatus::kIterationLimit:
      return fmt::format("stopped at the limit of {} {}", method.options.max_iterations, method.solver->step);
    case IkStatus::kConverged:
    case IkStatus::kBadInput:
      break;
  }
  return "";
}

/// Returns the limit of forward-kinematics passes for the penalised costs: one pass before the first step and one in
/// each step. Some solvers make further passes and may exceed the limit.
double LargestFkCount(int max_steps) { return max_steps + 1; }

/// Adds a cost, and the cost in penalised form. Both are missing if the method did not report the cost.
void AddCost(const char* id, const char* penalised_id, const std::optional<int>& spent, double limit, bool solved,
             CellResult& cell) {
  if (spent) {
    cell.Measure(id, *spent);
    cell.Measure(penalised_id, PenalisedCost(*spent, limit, solved && *spent <= limit));
  } else {
    for (const char* missing : {id, penalised_id})
      cell.Missing(missing, fmt::format("the method did not report its {}", id));
  }
}

}  // namespace

CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method,
                     const IkRecords& records) {
  IkOptions options = method.options;
  options.trace = true;
  if (!records.motion) options.max_trace_entries = kMaxCurveEntries;
  // Solve, with a trace for the curves.
  const IkSolution solution = method.solver->solve(tree, world.problem, options);
  std::vector<std::pair<std::string, std::string>> digests = {{"world", DigestOf(world)},
                                                              {"solution", DigestOf(solution)}};
  if (solution.status == IkStatus::kBadInput) {
    CellResult cell = CellResult::Ended(Status::kFailed, std::string(FindFault(tree, world.problem, method.options)));
    cell.digests = std::move(digests);
    return cell;
  }
  // Score the result, and add the curves and the recording.
  const IkAccount account{solution.iterations, solution.fk_evaluations, method.options.max_iterations,
                          WhyItStopped(method, solution, AskedOf(world.problem))};
  CellResult cell = ScoreAngles(tree, world, solution.angles, solution.errors, account, records);
  cell.digests = std::move(digests);
  std::ranges::move(WorstErrorCurves(solution.trace), std::back_inserter(cell.series));
  if (records.effector_curves) {
    std::ranges::move(EffectorCurves(tree, solution.trace), std::back_inserter(cell.series));
  }
  if (records.motion) cell.recording = RecordIk(tree, world, StepsOf(solution.trace));
  return cell;
}

std::vector<std::string> IkMetrics() {
  return {"position_error_cm",      "position_error_max_cm",
          "orientation_error_deg",  "orientation_error_max_deg",
          "hidden_angle_error_deg", "hidden_angle_change_deg",
          "solved_practical",       "solved_tight",
          "limit_violations",       "iterations",
          "iterations_par2",        "fk_evaluations",
          "fk_evaluations_par2"};
}

IkTargetParts AskedOf(const IkProblem& problem) {
  const EffectorTarget& target = problem.targets.front();
  return {.positions = target.position_weight > 0, .axes = target.axis_weights != glm::dvec3(0)};
}

CellResult ScoreAngles(const KinematicTree& tree, const IkWorld& world, std::span<const double> angles,
                       std::span<const EffectorError> effector_errors, const IkAccount& account,
                       const IkRecords& records) {
  const IkErrorSummary errors = SummariseIkErrors(effector_errors);
  const IkTargetParts asked = AskedOf(world.problem);
  const std::string broken_limits = DescribeBrokenLimits(tree, angles, "angles_deg");
  // If a limit is exceeded, the world counts as unsolved, but everything is still measured.
  const bool keeps_limits = broken_limits.empty(), solved = keeps_limits && IsSolvedPractically(errors, asked);
  CellResult cell;
  cell.Measure("position_error_cm", errors.position_cm);
  cell.Measure("position_error_max_cm", errors.position_max_cm);
  cell.Measure("orientation_error_deg", errors.orientation_deg);
  cell.Measure("orientation_error_max_deg", errors.orientation_max_deg);
  cell.Measure("hidden_angle_error_deg", HiddenAngleDifferenceDeg(angles, world.truth.angles));
  cell.Measure("hidden_angle_change_deg", HiddenAngleDifferenceDeg(angles, world.problem.start.angles));
  cell.Measure("solved_practical", solved ? 1 : 0);
  cell.Measure("solved_tight", keeps_limits && IsSolvedTightly(errors, asked) ? 1 : 0);
  cell.Measure("limit_violations", CountLimitViolations(angles, tree.limits));
  AddCost("iterations", "iterations_par2", account.iterations, account.max_steps, solved, cell);
  AddCost("fk_evaluations", "fk_evaluations_par2", account.fk_evaluations, LargestFkCount(account.max_steps), solved,
          cell);
  if (records.effector_errors) cell.series = EffectorErrors(tree, world.problem, angles);
  if (records.angle_changes) std::ranges::move(AngleChanges(world, angles), std::back_inserter(cell.series));
  cell.status = solved ? Status::kOk : Status::kUnsolved;
  cell.reason = solved ? "" : !keeps_limits ? broken_limits : account.why_not_met;
  return cell;
}

CellResult ScoreIkAnswer(const KinematicTree& tree, const IkWorld& world, const IkAnswer& answer, int max_steps,
                         const IkRecords& records) {
  // Measure the errors of the start and of the answer.
  TreeState state = world.problem.start;
  std::vector<EffectorError> begun, ended;
  MeasureErrors(ComputeFrames(tree, state), world.problem.targets, begun);
  state.angles = answer.angles;
  MeasureErrors(ComputeFrames(tree, state), world.problem.targets, ended);
  const IkAccount account{answer.iterations, answer.fk_evaluations, max_steps, "the targets are not met"};
  CellResult cell = ScoreAngles(tree, world, answer.angles, ended, account, records);
  cell.digests = {{"world", DigestOf(world)}, {"solution", Digest().Add(answer.angles).Hex()}};
  if (records.motion) {
    const auto step = [&](int iteration, const std::vector<double>& angles, std::span<const EffectorError> errors) {
      const IkErrorSummary worst = SummariseIkErrors(errors);
      return IkRecordedStep{iteration, angles, worst.position_max_cm, worst.orientation_max_deg, worst.axis_max_deg};
    };
    cell.recording = RecordIk(tree, world,
                              std::array{step(0, world.problem.start.angles, begun),
                                         step(answer.iterations.value_or(1), answer.angles, ended)});
  }
  return cell;
}

std::optional<double> IkValueOfFailure(std::string_view metric, int max_steps) {
  if (metric == "solved_practical" || metric == "solved_tight") return 0;
  if (metric == "iterations_par2") return PenalisedCost(0, max_steps, false);
  if (metric == "fk_evaluations_par2") return PenalisedCost(0, LargestFkCount(max_steps), false);
  return std::nullopt;
}

namespace {

constexpr std::array kAxisNames = {"x", "y", "z"};

template <class ValueOf>
Series Curve(std::string name, std::span<const IkTraceEntry> trace, const ValueOf& value_of) {
  Series curve{std::move(name), "iteration", {}};
  for (const IkTraceEntry& entry : trace.first(std::min<std::size_t>(trace.size(), kMaxCurveEntries))) {
    curve.values.push_back(value_of(entry));
  }
  return curve;
}

/// Appends six series with the names `prefix` + "position_error_x_cm", and so on.
void AppendErrors(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles,
                  std::string_view prefix, std::vector<Series>& series) {
  TreeState state = problem.start;
  state.angles.assign(angles.begin(), angles.end());
  const std::vector<LimbFrame> effectors = ComputeFrames(tree, state).effectors;
  for (int axis = 0; axis < 3; ++axis) {
    Series position{fmt::format("{}position_error_{}_cm", prefix, kAxisNames[axis]), "effector", {}};
    for (std::size_t e = 0; e < effectors.size(); ++e) {
      position.values.push_back(100 * (effectors[e].position[axis] - problem.targets[e].position[axis]));
    }
    series.push_back(std::move(position));
  }
  for (int axis = 0; axis < 3; ++axis) {
    Series orientation{fmt::format("{}orientation_error_{}_deg", prefix, kAxisNames[axis]), "effector", {}};
    for (std::size_t e = 0; e < effectors.size(); ++e) {
      orientation.values.push_back(Degrees(ErrorOf(effectors[e], problem.targets[e]).axis_angles[axis]));
    }
    series.push_back(std::move(orientation));
  }
}

Series Differences(std::string name, std::span<const double> angles, std::span<const double> others) {
  Series differences{std::move(name), "angle", {}};
  for (std::size_t i = 0; i < angles.size(); ++i) differences.values.push_back(Degrees(angles[i] - others[i]));
  return differences;
}

}  // namespace

std::vector<Series> WorstErrorCurves(std::span<const IkTraceEntry> trace) {
  return {Curve("position_error_max_cm", trace, [](const IkTraceEntry& entry) { return 100 * entry.worst_position; }),
          Curve("orientation_error_max_deg", trace,
                [](const IkTraceEntry& entry) { return Degrees(entry.worst_mean_axis); })};
}

std::vector<Series> EffectorCurves(const KinematicTree& tree, std::span<const IkTraceEntry> trace) {
  std::vector<Series> curves;
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    curves.push_back(Curve(fmt::format("{}_position_error_cm", tree.effectors[e].name), trace,
                           [&](const IkTraceEntry& entry) { return 100 * entry.errors[e].position; }));
    for (int axis = 0; axis < 3; ++axis) {
      curves.push_back(Curve(fmt::format("{}_{}_axis_error_deg", tree.effectors[e].name, kAxisNames[axis]), trace,
                             [&](const IkTraceEntry& entry) { return Degrees(entry.errors[e].axis_angles[axis]); }));
    }
  }
  return curves;
}

std::vector<Series> EffectorErrors(const KinematicTree& tree, const IkProblem& problem,
                                   std::span<const double> angles) {
  std::vector<Series> series;
  AppendErrors(tree, problem, problem.start.angles, "start_", series);
  AppendErrors(tree, problem, angles, "", series);
  return series;
}

std::vector<Series> AngleChanges(const IkWorld& world, std::span<const double> angles) {
  return {Differences("angle_change_deg", angles, world.problem.start.angles),
          Differences("angle_error_deg", angles, world.truth.angles)};
}

}  // namespace etude
