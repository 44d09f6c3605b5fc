#include "bench/tasks/tracking/run.h"

namespace etude {

Result<TrackingAnswer> Follow(const TrackingWorld& world, const TrackingMethod& method) {
  TrackingAnswer answer;
  answer.iterations.emplace();
  for (std::size_t frame = 0; frame < world.truth.size(); ++frame) {
    IkProblem problem{world.truth[frame], world.targets[frame], world.tree.limits};
    const bool is_warm = method.start == FrameStart::kWarm && frame > 0;
    problem.start.angles = is_warm ? answer.angles.back() : world.first_angles;
    IkSolution solution = method.solver->solve(world.tree, problem, method.options);
    if (solution.status == IkStatus::kBadInput) {
      return Fail({}, "frame {}: {}", frame, FindFault(world.tree, problem, method.options));
    }
    answer.angles.push_back(std::move(solution.angles));
    answer.iterations->push_back(solution.iterations);
  }
  return answer;
}

}  // namespace etude
