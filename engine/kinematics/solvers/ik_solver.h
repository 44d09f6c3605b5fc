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
  /// The very answer of `IkSolver::solve`, whatever was asked before.
  virtual IkSolution Solve(const IkProblem& problem, const IkOptions& options) const = 0;
};

/// A way to solve an IkProblem, by the name scenario files call it.
struct IkSolver {
  std::string name;
  std::string description;    ///< one line, for people
  bool uses_weights = false;  ///< whether IkOptions::weights and refresh apply
  bool uses_axes = true;      ///< whether it turns effectors into their desired axes; else it sees positions only
  std::string_view step;      ///< what one iteration is called: "sweeps", "steps"
  /// What `IkOptions::solver_settings` holds values for, in this order.
  std::vector<NumberSetting> settings = {};
  std::function<IkSolution(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options)> solve = {};
  /// For problems that come one after the other, looks once at what is the tree's own; empty when there is nothing to
  /// look at. `Prepare` chooses.
  std::function<std::unique_ptr<PreparedIkSolver>(const KinematicTree& tree)> prepare = {};
  /// Many problems of one tree, sooner than `solve` one by one and with its very answers, but for traces; empty when
  /// there is no such way. `SolveAll` chooses.
  std::function<std::vector<IkSolution>(const KinematicTree& tree, std::span<const IkProblem> problems,
                                        const IkOptions& options)>
      solve_batch = {};
};

/// `solver` for one problem of `tree` after the other. Both must outlive it.
std::unique_ptr<PreparedIkSolver> Prepare(const IkSolver& solver, const KinematicTree& tree);

/// What `solver.solve` answers to each of many problems of one tree.
std::vector<IkSolution> SolveAll(const IkSolver& solver, const KinematicTree& tree, std::span<const IkProblem> problems,
                                 const IkOptions& options);

std::span<const IkSolver> AllIkSolvers();
std::vector<std::string> IkSolverNames();
/// Null when there is no such solver.
const IkSolver* FindIkSolver(std::string_view name);

/// The name that the solver once called `name` has now; empty when none was called so.
std::string_view NewNameOfIkSolver(std::string_view name);

}  // namespace etude
