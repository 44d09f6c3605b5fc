#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// A solver made ready for one tree.
class PreparedIkSolver {
 public:
  virtual ~PreparedIkSolver() = default;
  /// Returns the very answer of `IkSolver::solve`, whatever was asked before.
  virtual IkSolution Solve(const IkProblem& problem, const IkOptions& options) const = 0;
};

/// A number that a solver can be set by.
struct IkSolverSetting {
  NumberSetting number;
  std::function<void(SolverSettings& settings, double value)> set;
};

/// A way to solve an IkProblem, with the name that scenario files call it.
struct IkSolver {
  std::string name;
  std::string description;    ///< one line, for people
  bool uses_weights = false;  ///< whether IkOptions::weights and refresh apply
  bool uses_axes = true;      ///< whether it turns effectors into their desired axes; else it sees positions only
  std::string_view step;      ///< what one iteration is called: "sweeps", "steps"
  std::vector<IkSolverSetting> settings = {};  ///< those of `IkOptions::solver_settings` that it reads
  std::function<IkSolution(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options)> solve = {};
  /// Makes the solver ready for problems of one tree that come one after the other; empty where there is nothing to
  /// prepare. Call `Prepare` instead.
  std::function<std::unique_ptr<PreparedIkSolver>(const KinematicTree& tree)> prepare = {};
  /// Solves many problems of one tree sooner than `solve` does one by one and with its very answers, but for traces;
  /// empty where there is no such way. Call `SolveAll` instead.
  std::function<std::vector<IkSolution>(const KinematicTree& tree, std::span<const IkProblem> problems,
                                        const IkOptions& options)>
      solve_batch = {};
};

/// Makes `solver` ready for one problem of `tree` after the other. Both must outlive the result.
std::unique_ptr<PreparedIkSolver> Prepare(const IkSolver& solver, const KinematicTree& tree);

/// Returns what `solver.solve` answers to each of many problems of one tree.
std::vector<IkSolution> SolveAll(const IkSolver& solver, const KinematicTree& tree, std::span<const IkProblem> problems,
                                 const IkOptions& options);

std::span<const IkSolver> AllIkSolvers();
std::vector<std::string> IkSolverNames();
/// Returns null when there is no such solver.
const IkSolver* FindIkSolver(std::string_view name);

/// Returns the name that the solver once called `name` has now; empty when none was called so.
std::string_view NewNameOfIkSolver(std::string_view name);

}  // namespace etude
