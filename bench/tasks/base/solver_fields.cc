#include "bench/tasks/base/solver_fields.h"

namespace etude {

const IkSolver* DefaultIkSolver() { return FindIkSolver("gauss-newton"); }

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

void RefuseFormerName(Fields& method) {
  const Node* solver = method.Raw("solver");
  const std::string_view now = solver == nullptr ? "" : NewNameOfIkSolver(solver->scalar);
  if (!now.empty()) method.Complain(solver->place, fmt::format("solver '{}' was renamed to '{}'", solver->scalar, now));
}

void ReadIkGoals(Fields& condition, IkOptions& options) {
  if (condition.Choice("stop_at", {"practical", "tight"}, "practical") == "practical") return;
  options.position_goal = 1e-5;
  options.axis_goal = Radians(1e-3);
}

}  // namespace etude
