#include "engine/kinematics/solvers/ik_solver.h"

#include "engine/kinematics/solvers/ccd.h"
#include "engine/kinematics/solvers/damped_least_squares.h"
#include "engine/kinematics/solvers/null_space.h"

namespace etude {

std::span<const IkSolver> AllIkSolvers() {
  static const std::vector<IkSolver> solvers = {
      {.name = "ccd",
       .description = "cyclic coordinate descent, joints taken apart as paper B does",
       .uses_weights = true,
       .step = "sweeps",
       .settings = {},
       .solve = SolveCcd},
      {.name = "ccd-hinges",
       .description = "cyclic coordinate descent, every joint a row of hinges",
       .uses_weights = true,
       .step = "sweeps",
       .settings = {},
       .solve = SolveCcdHinges},
      {.name = "ccd-nullspace",
       .description = "some sweeps, then Gauss-Newton steps that stay near the start (the default)",
       .step = "steps",
       .settings = {{"first_sweeps", &IkTuning::first_sweeps, 0, 100, "Sweeps before the first Gauss-Newton step."}},
       .solve = SolveNullSpace},
      {.name = "damped-least-squares",
       .description = "damped Gauss-Newton steps, limits by clamping",
       .step = "steps",
       .settings = {{"damping", &IkTuning::first_damping, 1e-9, 1e6, "The damping of the first step."}},
       .solve = SolveDampedLeastSquares},
  };
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
