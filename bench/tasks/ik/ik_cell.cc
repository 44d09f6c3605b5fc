#include "bench/tasks/ik/ik_cell.h"

#include <algorithm>
#include <array>

#include "bench/metrics/ik_cost.h"
#include "bench/metrics/ik_error.h"
#include "engine/base/angles.h"
#include "engine/base/digest.h"
#include "engine/kinematics/tree_to_body.h"

namespace etude {
namespace {

constexpr std::size_t kLongestCurve = 200;     // iterations
constexpr std::size_t kLongestRecording = 90;  // iterations, one frame each: three seconds

std::string DigestOf(const IkWorld& world) {
  Digest digest;
  digest.Add(world.truth.angles).Add(world.problem.start.angles);
  return digest.Hex();
}

std::string DigestOf(const IkSolution& solution) {
  Digest digest;
  digest.Add(solution.angles).Add(static_cast<std::int64_t>(solution.iterations));
  return digest.Hex();
}

/// Every solver here makes one pass of forward kinematics before its first step and one in each.
double LargestFkCount(int max_steps) { return max_steps + 1; }

/// What a method says that its answer cost; empty where it says nothing.
struct IkCost {
  std::optional<int> iterations, fk_evaluations;
  int max_steps = 0;
};

void AddCost(const char* id, const char* penalised_id, const std::optional<int>& spent, double limit, bool solved,
             CellResult& cell) {
  if (spent) {
    cell.Measure(id, *spent);
    cell.Measure(penalised_id, PenalisedCost(*spent, limit, solved && *spent <= limit));
  } else {
    for (const char* missing : {id, penalised_id}) cell.Missing(missing, "the method did not say what it took");
  }
}

void AddMetrics(const IkWorld& world, std::span<const double> angles, const IkErrorSummary& errors, bool keeps_limits,
                const IkCost& cost, CellResult& cell) {
  const bool solved = keeps_limits && IsSolvedPractically(errors);
  cell.Measure("position_error_cm", errors.position_cm);
  cell.Measure("position_error_max_cm", errors.position_max_cm);
  cell.Measure("orientation_error_deg", errors.orientation_deg);
  cell.Measure("orientation_error_max_deg", errors.orientation_max_deg);
  cell.Measure("hidden_angle_error_deg", HiddenAngleDifferenceDeg(angles, world.truth.angles));
  cell.Measure("hidden_angle_change_deg", HiddenAngleDifferenceDeg(angles, world.problem.start.angles));
  cell.Measure("solved_practical", solved ? 1 : 0);
  cell.Measure("solved_tight", keeps_limits && IsSolvedTightly(errors) ? 1 : 0);
  AddCost("iterations", "iterations_par2", cost.iterations, cost.max_steps, solved, cell);
  AddCost("fk_evaluations", "fk_evaluations_par2", cost.fk_evaluations, LargestFkCount(cost.max_steps), solved, cell);
}

void AddCurves(const IkSolution& solution, CellResult& cell) {
  Series position{"position_error_max_cm", "iteration", {}};
  Series orientation{"orientation_error_max_deg", "iteration", {}};
  for (std::size_t i = 0; i < std::min(solution.trace.size(), kLongestCurve); ++i) {
    position.values.push_back(100 * solution.trace[i].worst_position);
    orientation.values.push_back(Degrees(solution.trace[i].worst_axis));
  }
  cell.series = {std::move(position), std::move(orientation)};
}

/// `path`: the angles from the start to the solution.
Recording Record(const KinematicTree& tree, const IkWorld& world, std::span<const std::vector<double>> path) {
  Track truth{"truth", {}}, start{"start", {}}, found{"solution", {}};
  TreeState state = world.problem.start;
  const BodyPose true_pose = ToBodyPose(tree, world.truth), start_pose = ToBodyPose(tree, state);
  for (const std::vector<double>& angles : path.first(std::min(path.size(), kLongestRecording))) {
    state.angles = angles;
    truth.motion.poses.push_back(true_pose);
    start.motion.poses.push_back(start_pose);
    found.motion.poses.push_back(ToBodyPose(tree, state));
  }
  return {{std::move(truth), std::move(start), std::move(found)}, "{}"};
}

std::vector<std::vector<double>> PathOf(const IkSolution& solution) {
  std::vector<std::vector<double>> path;
  for (const IkTraceEntry& entry : solution.trace) path.push_back(entry.angles);
  return path;
}

/// "2 angles outside the limits, angles_deg[4] the farthest, by 3.2°", or nothing.
std::string DescribeBrokenLimits(const KinematicTree& tree, std::span<const double> angles) {
  constexpr double kRounding = Radians(1e-6);
  int broken = 0;
  double worst = 0;
  std::size_t worst_angle = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double beyond = std::max(tree.limits[i].lower - angles[i], angles[i] - tree.limits[i].upper);
    if (beyond <= kRounding) continue;
    ++broken;
    if (beyond > worst) {
      worst = beyond;
      worst_angle = i;
    }
  }
  if (broken == 0) return "";
  return fmt::format("{} angle{} outside the limits, angles_deg[{}] the farthest, by {:.2g}°", broken,
                     broken == 1 ? "" : "s", worst_angle, Degrees(worst));
}

std::string DescribeErrors(const IkErrorSummary& errors) {
  return fmt::format("worst effector {:.2g} cm, {:.2g}°", errors.position_max_cm, errors.orientation_max_deg);
}

}  // namespace

CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, bool keeps_motion) {
  CellResult cell;
  const IkSolution solution = method.solver->solve(tree, world.problem, method.options);
  cell.digests = {{"world", DigestOf(world)}, {"solution", DigestOf(solution)}};
  if (solution.status == IkStatus::kBadInput) {
    cell.status = Status::kFailed;
    cell.reason = FindFault(tree, world.problem, method.options);
    return cell;
  }
  const IkErrorSummary errors = SummariseIkErrors(solution.errors);
  const std::string broken_limits = DescribeBrokenLimits(tree, solution.angles);  // by a solver told to ignore them
  AddMetrics(world, solution.angles, errors, broken_limits.empty(),
             {solution.iterations, solution.fk_evaluations, method.options.max_iterations}, cell);
  AddCurves(solution, cell);
  if (keeps_motion) cell.recording = Record(tree, world, PathOf(solution));
  cell.status = Status::kUnsolved;
  if (!broken_limits.empty()) {
    cell.reason = broken_limits;
  } else if (IsSolvedPractically(errors)) {
    cell.status = Status::kOk;
    cell.reason.clear();
  } else {
    cell.reason = fmt::format("{} after {} {}{}", DescribeErrors(errors), solution.iterations, method.solver->step,
                              solution.status == IkStatus::kStalled ? ", stalled" : "");
  }
  return cell;
}

CellResult ScoreIkAnswer(const KinematicTree& tree, const IkWorld& world, const IkAnswer& answer, int max_steps,
                         bool keeps_motion) {
  TreeState state = world.problem.start;
  state.angles = answer.angles;
  const TreeFrames frames = ComputeFrames(tree, state);
  std::vector<EffectorError> effectors;
  for (std::size_t e = 0; e < frames.effectors.size(); ++e) {
    effectors.push_back(ErrorOf(frames.effectors[e], world.problem.targets[e]));
  }
  const IkErrorSummary errors = SummariseIkErrors(effectors);
  const std::string broken_limits = DescribeBrokenLimits(tree, answer.angles);
  CellResult cell;
  cell.digests = {{"world", DigestOf(world)}, {"solution", Digest().Add(answer.angles).Hex()}};
  AddMetrics(world, answer.angles, errors, broken_limits.empty(), {answer.iterations, answer.fk_evaluations, max_steps},
             cell);
  if (keeps_motion) cell.recording = Record(tree, world, std::array{world.problem.start.angles, answer.angles});
  cell.status = Status::kUnsolved;
  if (!broken_limits.empty()) {
    cell.reason = broken_limits;
  } else if (!IsSolvedPractically(errors)) {
    cell.reason = DescribeErrors(errors);
  } else {
    cell.status = Status::kOk;
    cell.reason.clear();
  }
  return cell;
}

std::optional<double> IkValueOfFailure(std::string_view metric, int max_steps) {
  if (metric == "solved_practical" || metric == "solved_tight") return 0;
  if (metric == "iterations_par2") return PenalisedCost(0, max_steps, false);
  if (metric == "fk_evaluations_par2") return PenalisedCost(0, LargestFkCount(max_steps), false);
  return std::nullopt;
}

}  // namespace etude
