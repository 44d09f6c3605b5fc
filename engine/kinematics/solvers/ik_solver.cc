#include "engine/kinematics/solvers/ik_solver.h"

#include "engine/kinematics/solvers/ccd.h"
#include "engine/kinematics/solvers/ccd_anderson.h"
#include "engine/kinematics/solvers/ceres_lm.h"
#include "engine/kinematics/solvers/damped_least_squares.h"
#include "engine/kinematics/solvers/fabrik.h"
#include "engine/kinematics/solvers/jacobian_pinv.h"
#include "engine/kinematics/solvers/jacobian_transpose.h"
#include "engine/kinematics/solvers/gauss_newton.h"

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
      {.name = "ccd-anderson",
       .description = "the sweeps of ccd-hinges, extrapolated from the last ones",
       .uses_weights = true,
       .step = "sweeps",
       .settings = {{"memory", &IkTuning::memory, 1, 20, "How many former sweeps the extrapolation uses."}},
       .solve = SolveCcdAnderson},
      {.name = "gauss-newton",
       .description = "Gauss-Newton steps that stay near the start, sweeps where they get stuck (the default)",
       .step = "steps",
       .settings = {{"first_sweeps", &IkTuning::first_sweeps, 0, 100, "Sweeps before the first Gauss-Newton step."}},
       .solve = SolveGaussNewton},
      {.name = "ceres-lm",
       .description = "the Levenberg-Marquardt method of Ceres Solver, limits as bounds",
       .step = "steps",
       .settings = {{"first_radius", &IkTuning::first_radius, 1e-6, 1e12, "The trust region it begins with."}},
       .solve = SolveCeresLm},
      {.name = "damped-least-squares",
       .description = "damped Gauss-Newton steps, limits by clamping",
       .step = "steps",
       .settings = {{"damping", &IkTuning::first_damping, 1e-9, 1e6, "The damping of the first step."}},
       .solve = SolveDampedLeastSquares},
      {.name = "fabrik",
       .description = "joints as points that reach forward and backward, positions only",
       .uses_axes = false,
       .step = "passes",
       .settings = {},
       .solve = SolveFabrik},
      {.name = "jacobian-pinv",
       .description = "the Jacobian's pseudo-inverse, and the start pose as a wish in its null space",
       .step = "steps",
       .settings = {{"pinv_damping", &IkTuning::pinv_damping, 0, 100, "Damping of the inverse; 0 is paper B's."}},
       .solve = SolveJacobianPinv},
      {.name = "jacobian-transpose",
       .description = "the Jacobian's transpose, steps of the length that is best to first order",
       .step = "steps",
       .settings = {{"gain", &IkTuning::gain, 0.01, 2, "Multiplies the length of every step."}},
       .solve = SolveJacobianTranspose},
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
