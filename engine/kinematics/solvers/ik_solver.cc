#include "engine/kinematics/solvers/ik_solver.h"

#include <array>
#include <type_traits>
#include <utility>

#include "engine/base/named.h"
#include "engine/kinematics/solvers/ccd.h"
#include "engine/kinematics/solvers/ceres_lm.h"
#include "engine/kinematics/solvers/fabrik.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/solvers/jacobian_solvers.h"

namespace etude {

namespace {

// Former names of solvers, with their present names.
constexpr std::array<std::pair<std::string_view, std::string_view>, 1> kRenamed = {{{"ccd-nullspace", "gauss-newton"}}};

template <typename Own>
using SolveWithOwn = IkSolution (*)(const KinematicTree&, const IkProblem&, const IkOptions&, const Own&);

template <typename Own>
Own OwnOptions(const SolverSettings& settings, auto SolverSettings::*told, auto Own::*member) {
  Own own;
  own.*member = (settings.*told).value_or(own.*member);
  return own;
}

/// Makes an IkSolver of a function that has options of its own. The setting `told` of SolverSettings, if it has a
/// value, sets `member` of these options. `number.fallback` is set to the default of `member`.
template <typename Own, typename Number>
IkSolver WithSetting(IkSolver solver, SolveWithOwn<Own> solve, std::optional<Number> SolverSettings::*told,
                     Number Own::*member, NumberSetting number) {
  number.fallback = Own().*member;
  number.is_whole = std::is_same_v<Number, int>;
  solver.settings.push_back({std::move(number), [told](SolverSettings& settings, double value) {
                               settings.*told = static_cast<Number>(value);
                             }});
  solver.solve = [=](const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
    return solve(tree, problem, options, OwnOptions<Own>(options.solver_settings, told, member));
  };
  return solver;
}

NumberSetting Between(std::string key, double lowest, double largest, std::string meaning) {
  return {.key = std::move(key), .lowest = lowest, .largest = largest, .meaning = std::move(meaning)};
}

GaussNewtonOptions GaussNewtonOptionsOf(const IkOptions& options) {
  return OwnOptions(options.solver_settings, &SolverSettings::first_sweeps, &GaussNewtonOptions::first_sweeps);
}

class PreparedGaussNewton final : public PreparedIkSolver {
 public:
  explicit PreparedGaussNewton(const KinematicTree& tree) : solver_(tree) {}
  IkSolution Solve(const IkProblem& problem, const IkOptions& options) const override {
    return solver_.Solve(problem, options, GaussNewtonOptionsOf(options));
  }

 private:
  const GaussNewtonSolver solver_;
};

/// A PreparedIkSolver for a solver that needs no preparation.
class Unprepared final : public PreparedIkSolver {
 public:
  Unprepared(const IkSolver& solver, const KinematicTree& tree) : solver_(solver), tree_(tree) {}
  IkSolution Solve(const IkProblem& problem, const IkOptions& options) const override {
    return solver_.solve(tree_, problem, options);
  }

 private:
  const IkSolver& solver_;
  const KinematicTree& tree_;
};

IkSolver GaussNewton() {
  IkSolver solver = WithSetting(
      {.name = "gauss-newton",
       .description =
           "Gauss-Newton steps that stay near the start pose, with CCD sweeps if the steps get stuck (the default)",
       .step = "steps"},
      SolveWithOwn<GaussNewtonOptions>(SolveGaussNewton), &SolverSettings::first_sweeps,
      &GaussNewtonOptions::first_sweeps,
      Between("first_sweeps", 0, 100, "Number of CCD sweeps before the first Gauss-Newton step."));
  solver.prepare = [](const KinematicTree& tree) { return std::make_unique<PreparedGaussNewton>(tree); };
  solver.solve_batch = [](const KinematicTree& tree, std::span<const IkProblem> problems, const IkOptions& options) {
    return SolveGaussNewtonBatch(tree, problems, options, Precision::kDouble, GaussNewtonOptionsOf(options));
  };
  return solver;
}

IkSolution SolveDampedLeastSquaresActiveSet(const KinematicTree& tree, const IkProblem& problem,
                                            const IkOptions& options, const DampedLeastSquaresOptions& own) {
  DampedLeastSquaresOptions within = own;
  within.bounds = Bounds::kActiveSet;
  return SolveDampedLeastSquares(tree, problem, options, within);
}

}  // namespace

// A new solver is one row here. Its options, if it has any, are a struct in its own header.
std::span<const IkSolver> AllIkSolvers() {
  static const std::vector<IkSolver> solvers = {
      // Cyclic coordinate descent.
      {.name = "ccd",
       .description = "cyclic coordinate descent, with joints decomposed as in paper B",
       .uses_weights = true,
       .step = "sweeps",
       .solve = SolveCcd},
      {.name = "ccd-hinges",
       .description = "cyclic coordinate descent, with every joint as a chain of hinges",
       .uses_weights = true,
       .step = "sweeps",
       .solve = SolveCcdHinges},
      WithSetting({.name = "ccd-anderson",
                   .description = "the sweeps of ccd-hinges, with Anderson extrapolation from the previous sweeps",
                   .uses_weights = true,
                   .step = "sweeps"},
                  SolveWithOwn<CcdAndersonOptions>(SolveCcdAnderson), &SolverSettings::memory,
                  &CcdAndersonOptions::memory,
                  Between("memory", 1, 20, "Number of previous sweeps that the extrapolation uses.")),
      // Damped least squares.
      GaussNewton(),
      WithSetting(
          {.name = "levenberg-marquardt",
           .description = "dense Levenberg-Marquardt steps with restarts and an active set for the limits: the usual "
                          "recommendation today",
           .step = "steps"},
          SolveWithOwn<LevenbergMarquardtOptions>(SolveLevenbergMarquardt), &SolverSettings::damping_share,
          &LevenbergMarquardtOptions::damping_share,
          Between("damping_share", 1e-6, 1e3, "Damping of the first step as a fraction of the sum of squares.")),
      WithSetting({.name = "ceres-lm",
                   .description = "the Levenberg-Marquardt method of Ceres Solver, with limits as bounds",
                   .step = "steps"},
                  SolveWithOwn<CeresLmOptions>(SolveCeresLm), &SolverSettings::first_radius,
                  &CeresLmOptions::first_radius,
                  Between("first_radius", 1e-6, 1e12, "Radius of the first trust region.")),
      WithSetting({.name = "damped-least-squares",
                   .description = "damped Gauss-Newton steps; angles are clamped to their limits",
                   .step = "steps"},
                  SolveWithOwn<DampedLeastSquaresOptions>(SolveDampedLeastSquares), &SolverSettings::damping,
                  &DampedLeastSquaresOptions::first_damping,
                  Between("damping", 1e-9, 1e6, "The damping of the first step.")),
      WithSetting({.name = "damped-least-squares-active-set",
                   .description = "like damped-least-squares, but with an active set for the limits: other angles "
                                  "compensate for angles at their limits",
                   .step = "steps"},
                  SolveWithOwn<DampedLeastSquaresOptions>(SolveDampedLeastSquaresActiveSet), &SolverSettings::damping,
                  &DampedLeastSquaresOptions::first_damping,
                  Between("damping", 1e-9, 1e6, "The damping of the first step.")),
      // Methods that move joints as points.
      {.name = "fabrik",
       .description = "forward and backward reaching inverse kinematics (FABRIK): moves joints as points and reaches "
                      "positions only",
       .uses_axes = false,
       .step = "passes",
       .solve = SolveFabrik},
      // Methods that do not check whether a step lowers the error.
      WithSetting({.name = "jacobian-pinv",
                   .description = "paper B's Jacobian pseudo-inverse: the start pose is the preferred posture, and "
                                  "angles are clamped to their limits",
                   .step = "steps"},
                  SolveWithOwn<JacobianPinvOptions>(SolveJacobianPinv), &SolverSettings::pinv_damping,
                  &JacobianPinvOptions::damping,
                  Between("pinv_damping", 0, 100, "Damping of the pseudo-inverse. Paper B uses 0.")),
      WithSetting(
          {.name = "jacobian-transpose",
           .description = "the Jacobian transpose, with the step length that minimises the error to first order",
           .step = "steps"},
          SolveWithOwn<JacobianTransposeOptions>(SolveJacobianTranspose), &SolverSettings::gain,
          &JacobianTransposeOptions::gain, Between("gain", 0.01, 2, "Factor on the length of every step.")),
  };
  return solvers;
}

std::unique_ptr<PreparedIkSolver> Prepare(const IkSolver& solver, const KinematicTree& tree) {
  if (solver.prepare) return solver.prepare(tree);
  return std::make_unique<Unprepared>(solver, tree);
}

std::vector<IkSolution> SolveAll(const IkSolver& solver, const KinematicTree& tree, std::span<const IkProblem> problems,
                                 const IkOptions& options) {
  if (solver.solve_batch && !options.trace) return solver.solve_batch(tree, problems, options);
  const auto prepared = Prepare(solver, tree);
  std::vector<IkSolution> solutions;
  for (const IkProblem& problem : problems) solutions.push_back(prepared->Solve(problem, options));
  return solutions;
}

std::vector<std::string> IkSolverNames() { return NamesOf(AllIkSolvers()); }
const IkSolver* FindIkSolver(std::string_view name) { return FindByName(AllIkSolvers(), name); }

std::string_view NewNameOfIkSolver(std::string_view name) {
  for (const auto& [former, now] : kRenamed) {
    if (former == name) return now;
  }
  return {};
}

}  // namespace etude
