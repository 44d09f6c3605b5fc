#include "bench/tasks/base/solver_fields.h"

namespace etude {

const IkSolver* ReadIkSolver(Fields& fields, IkOptions& options) {
  const IkSolver* solver = FindIkSolver(fields.Choice("solver", IkSolverNames(), "ccd"));
  if (solver->uses_weights) {
    options.weights = *FindWeightRule(fields.Choice("weights", WeightRuleNames(), "adaptive"));
    options.refresh = *FindWeightRefresh(fields.Choice("refresh", WeightRefreshNames(), "sweep"));
    return solver;
  }
  for (const char* key : {"weights", "refresh"}) {
    const Node* value = fields.Raw(key);
    if (value != nullptr) fields.Complain(value->place, fmt::format("solver '{}' has no '{}'", solver->name, key));
  }
  return solver;
}

}  // namespace etude
