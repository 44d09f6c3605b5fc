#include "cli/solver_list.h"

#include <fmt/core.h>

#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {

void PrintSolvers() {
  fmt::print("Solvers of inverse kinematics:\n");
  for (const IkSolver& solver : AllIkSolvers()) fmt::print("  {:<20}  {}\n", solver.name, solver.description);
}

}  // namespace etude
