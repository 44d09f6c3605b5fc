#include "bench/tasks/ik/run.h"

#include <algorithm>
#include <iterator>

#include "bench/tasks/ik/exchange.h"
#include "bench/tasks/ik/score.h"
#include "bench/tasks/ik/series.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

std::string DigestOf(const IkSolution& solution) {
  Digest digest;
  digest.Add(solution.angles).Add(static_cast<std::int64_t>(solution.iterations));
  return digest.Hex();
}

/// The same words for all cells that ended alike, so that a report can count them; how far each came is in its metrics.
std::string WhyItStopped(const IkMethod& method, const IkSolution& solution, const IkAsked& asked) {
  if (asked.axes && !method.solver->uses_axes) return "the solver sees positions only, and axes are asked for";
  switch (solution.status) {
    case IkStatus::kStalled:
      return "stalled before the targets were met";
    case IkStatus::kUnreachable:
      return "a target is out of reach";
    case IkStatus::kIterationLimit:
      return fmt::format("the limit of {} {}", method.options.max_iterations, method.solver->step);
    case IkStatus::kConverged:
    case IkStatus::kBadInput:
      break;
  }
  return "";
}

}  // namespace

CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method,
                     const IkRecords& records) {
  IkOptions options = method.options;
  options.trace = true;
  if (!records.motion) options.longest_trace = kLongestCurve;
  const IkSolution solution = method.solver->solve(tree, world.problem, options);
  std::vector<std::pair<std::string, std::string>> digests = {{"world", DigestOf(world)},
                                                              {"solution", DigestOf(solution)}};
  if (solution.status == IkStatus::kBadInput) {
    CellResult cell = CellResult::Ended(Status::kFailed, std::string(FindFault(tree, world.problem, method.options)));
    cell.digests = std::move(digests);
    return cell;
  }
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

}  // namespace etude
