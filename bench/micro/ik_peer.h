#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The answer of a peer.
struct IkPeerAnswer {
  std::vector<double> angles;
  int steps = -1;  ///< −1: it does not tell
};

/// An outside library's inverse kinematics, its model built once for a tree whose root stays where `StandingState` has
/// it. Everything that can be made ahead of a problem is.
class IkPeer {
 public:
  virtual ~IkPeer() = default;

  /// Returns where the library's own forward kinematics has the effectors: its model must be the tree.
  virtual std::vector<LimbFrame> Effectors(std::span<const double> angles) = 0;

  /// Returns what it finds from `problem.start`, to the goals of `options` as far as its own stop criteria can say so.
  virtual IkPeerAnswer Solve(const IkProblem& problem, const IkOptions& options) = 0;
};

}  // namespace etude
