#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// A way to solve an IkProblem, by the name scenario files call it.
struct IkSolver {
  std::string name;
  std::string description;    ///< one line, for people
  bool uses_weights = false;  ///< whether IkOptions::weights and refresh apply
  IkSolution (*solve)(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);
};

std::span<const IkSolver> AllIkSolvers();
std::vector<std::string> IkSolverNames();
/// Null when there is no such solver.
const IkSolver* FindIkSolver(std::string_view name);

}  // namespace etude
