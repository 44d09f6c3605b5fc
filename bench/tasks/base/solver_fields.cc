#include "bench/tasks/base/solver_fields.h"

namespace etude {

const IkSolver* DefaultIkSolver() { return FindIkSolver("ccd-nullspace"); }

IkOptions IkBudget(int most_steps) {
  IkOptions options;
  options.max_iterations = most_steps;
  return options;
}

std::vector<std::string> WeighingSolvers() {
  std::vector<std::string> names;
  for (const IkSolver& solver : AllIkSolvers()) {
    if (solver.uses_weights) names.push_back(solver.name);
  }
  return names;
}

void ReadIkGoals(Fields& condition, IkOptions& options) {
  if (condition.Choice("stop_at", {"practical", "tight"}, "practical") == "practical") return;
  options.position_goal = 1e-5;
  options.axis_goal = Radians(1e-3);
}

}  // namespace etude
