#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// A number that one solver can be set by, as scenario files name it.
struct IkSetting {
  std::string key;
  std::variant<int IkTuning::*, double IkTuning::*> member;
  double lowest = 0, largest = 0;  ///< both allowed
  std::string meaning;             ///< one sentence, for people
};

/// A way to solve an IkProblem, by the name scenario files call it.
struct IkSolver {
  std::string name;
  std::string description;    ///< one line, for people
  bool uses_weights = false;  ///< whether IkOptions::weights and refresh apply
  bool uses_axes = true;      ///< whether it turns effectors into their wanted axes; else it sees positions only
  std::string_view step;      ///< what one iteration is called: "sweeps", "steps"
  std::vector<IkSetting> settings;
  IkSolution (*solve)(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) = nullptr;
};

std::span<const IkSolver> AllIkSolvers();
std::vector<std::string> IkSolverNames();
/// Null when there is no such solver.
const IkSolver* FindIkSolver(std::string_view name);

}  // namespace etude
