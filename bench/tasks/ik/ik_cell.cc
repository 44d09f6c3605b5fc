#include "bench/tasks/ik/ik_cell.h"

#include <algorithm>

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

void AddMetrics(const IkWorld& world, const IkSolution& solution, const IkErrorSummary& errors, CellResult& cell) {
  cell.Measure("position_error_cm", errors.position_cm);
  cell.Measure("position_error_max_cm", errors.position_max_cm);
  cell.Measure("orientation_error_deg", errors.orientation_deg);
  cell.Measure("orientation_error_max_deg", errors.orientation_max_deg);
  cell.Measure("hidden_angle_error_deg", HiddenAngleDifferenceDeg(solution.angles, world.truth.angles));
  cell.Measure("hidden_angle_change_deg", HiddenAngleDifferenceDeg(solution.angles, world.problem.start.angles));
  cell.Measure("solved_practical", IsSolvedPractically(errors) ? 1 : 0);
  cell.Measure("solved_tight", IsSolvedTightly(errors) ? 1 : 0);
  cell.Measure("iterations", solution.iterations);
  cell.Measure("fk_evaluations", solution.fk_evaluations);
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

Recording Record(const KinematicTree& tree, const IkWorld& world, const IkSolution& solution) {
  Track truth{"truth", {}}, start{"start", {}}, found{"solution", {}};
  TreeState state = world.problem.start;
  const BodyPose true_pose = ToBodyPose(tree, world.truth), start_pose = ToBodyPose(tree, state);
  for (std::size_t i = 0; i < std::min(solution.trace.size(), kLongestRecording); ++i) {
    state.angles = solution.trace[i].angles;
    truth.motion.poses.push_back(true_pose);
    start.motion.poses.push_back(start_pose);
    found.motion.poses.push_back(ToBodyPose(tree, state));
  }
  return {{std::move(truth), std::move(start), std::move(found)}, "{}"};
}

}  // namespace

CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, bool wants_recording) {
  CellResult cell;
  const IkSolution solution = method.solver->solve(tree, world.problem, method.options);
  cell.digests = {{"world", DigestOf(world)}, {"solution", DigestOf(solution)}};
  if (solution.status == IkStatus::kBadInput) {
    cell.status = Status::kFailed;
    cell.reason = FindFault(tree, world.problem, method.options);
    return cell;
  }
  const IkErrorSummary errors = SummariseIkErrors(solution.errors);
  AddMetrics(world, solution, errors, cell);
  AddCurves(solution, cell);
  if (wants_recording) cell.recording = Record(tree, world, solution);
  if (IsSolvedPractically(errors)) {
    cell.status = Status::kOk;
    cell.reason.clear();
  } else {
    cell.status = Status::kUnsolved;
    cell.reason =
        fmt::format("worst effector {:.2g} cm, {:.2g}° after {} {}{}", errors.position_max_cm,
                    errors.orientation_max_deg, solution.iterations, method.solver->uses_weights ? "sweeps" : "steps",
                    solution.status == IkStatus::kStalled ? ", stalled" : "");
  }
  return cell;
}

}  // namespace etude
