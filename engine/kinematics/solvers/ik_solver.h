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

/// A solver that is prepared for one tree.
class PreparedIkSolver {
 public:
  virtual ~PreparedIkSolver() = default;
  /// Returns the same solution as `IkSolver::solve`, regardless of earlier calls.
  virtual IkSolution Solve(const IkProblem& problem, const IkOptions& options) const = 0;
};

/// A numeric setting of a solver, and the function that sets it.
struct IkSolverSetting {
  NumberSetting number;
  std::function<void(SolverSettings& settings, double value)> set;
};

/// A solver of IkProblems; `name` is its name in scenario files.
struct IkSolver {
  std::string name;
  std::string description;    ///< one line, for people
  bool uses_weights = false;  ///< true if IkOptions::weights and refresh apply
  bool uses_axes = true;      ///< true if the solver aligns the effectors' axes; false if it only moves effectors
  std::string_view step;      ///< the word for iterations: "sweeps", "steps"
  std::vector<IkSolverSetting> settings = {};  ///< the settings in `IkOptions::solver_settings` that the solver reads
  std::function<IkSolution(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options)> solve = {};
  /// Prepares the solver for problems of one tree that come one after the other; an empty function if there is nothing
  /// to prepare. Callers use the function `Prepare` instead.
  std::function<std::unique_ptr<PreparedIkSolver>(const KinematicTree& tree)> prepare = {};
  /// Solves many problems of one tree faster than `solve` one by one, with the same answers except for traces; an empty
  /// function if there is no faster method. Callers use the function `SolveAll` instead.
  std::function<std::vector<IkSolution>(const KinematicTree& tree, std::span<const IkProblem> problems,
                                        const IkOptions& options)>
      solve_batch = {};
};

/// Prepares `solver` for problems of `tree`. `solver` and `tree` must outlive the result.
std::unique_ptr<PreparedIkSolver> Prepare(const IkSolver& solver, const KinematicTree& tree);

/// Returns the answers of `solver.solve` to many problems of one tree.
std::vector<IkSolution> SolveAll(const IkSolver& solver, const KinematicTree& tree, std::span<const IkProblem> problems,
                                 const IkOptions& options);

std::span<const IkSolver> AllIkSolvers();
std::vector<std::string> IkSolverNames();
/// Finds a solver by its name; returns null if no solver has this name.
const IkSolver* FindIkSolver(std::string_view name);

/// Returns the present name of the solver that was formerly called `name`; an empty text if there was no such solver.
std::string_view NewNameOfIkSolver(std::string_view name);

}  // namespace etude
