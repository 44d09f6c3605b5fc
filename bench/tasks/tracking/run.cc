#include "bench/tasks/tracking/run.h"

namespace etude {
namespace {

IkProblem ProblemAt(const TrackingWorld& world, std::size_t frame, const std::vector<double>& start_angles) {
  IkProblem problem{world.truth[frame], world.targets[frame], world.tree.limits};
  problem.start.angles = start_angles;
  return problem;
}

/// Puts down a frame's solution; `problem` is asked for where it is bad.
Result<void> Take(IkSolution solution, const IkProblem& problem, const TrackingWorld& world,
                  const TrackingMethod& method, TrackingAnswer& answer) {
  if (solution.status == IkStatus::kBadInput) {
    return Fail({}, "frame {}: {}", answer.angles.size(), FindFault(world.tree, problem, method.options));
  }
  answer.angles.push_back(std::move(solution.angles));
  answer.iterations->push_back(solution.iterations);
  return {};
}

}  // namespace

Result<TrackingAnswer> Follow(const TrackingWorld& world, const TrackingMethod& method) {
  TrackingAnswer answer;
  answer.iterations.emplace();
  if (method.start == FrameStart::kCold) {  // no frame waits for another
    std::vector<IkProblem> problems;
    for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
      problems.push_back(ProblemAt(world, frame, world.first_angles));
    }
    std::vector<IkSolution> solutions = SolveAll(*method.solver, world.tree, problems, method.options);
    for (std::size_t frame = 0; frame < problems.size(); ++frame) {
      RETURN_IF_ERROR(Take(std::move(solutions[frame]), problems[frame], world, method, answer));
    }
    return answer;
  }
  const auto solver = Prepare(*method.solver, world.tree);
  for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
    const IkProblem problem = ProblemAt(world, frame, frame > 0 ? answer.angles.back() : world.first_angles);
    IkSolution solution = solver->Solve(problem, method.options);
    RETURN_IF_ERROR(Take(std::move(solution), problem, world, method, answer));
  }
  return answer;
}

}  // namespace etude
