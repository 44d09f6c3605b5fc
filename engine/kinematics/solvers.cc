#include "engine/kinematics/solvers.h"

#include <array>

#include "engine/kinematics/ccd.h"
#include "engine/kinematics/damped_least_squares.h"

namespace etude {

std::span<const IkSolver> AllIkSolvers() {
  static const std::array<IkSolver, 3> solvers = {{
      {"ccd", "cyclic coordinate descent, joints taken apart as paper B does", true, SolveCcd},
      {"ccd-hinges", "cyclic coordinate descent, every joint a row of hinges", true, SolveCcdHinges},
      {"damped-least-squares", "damped Gauss-Newton steps, limits by clamping", false, SolveDampedLeastSquares},
  }};
  return solvers;
}

std::vector<std::string> IkSolverNames() {
  std::vector<std::string> names;
  for (const IkSolver& solver : AllIkSolvers()) names.push_back(solver.name);
  return names;
}

const IkSolver* FindIkSolver(std::string_view name) {
  for (const IkSolver& solver : AllIkSolvers()) {
    if (solver.name == name) return &solver;
  }
  return nullptr;
}

}  // namespace etude
