#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/peers/simbody_model.h"
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

/// Makes a peer that does Levenberg–Marquardt as `levenberg-marquardt` does it, with an active set and the same
/// restarts, but written for speed alone: lists of fixed sizes, no check of its input, no record of its way, and
/// compiled with flags of its own
/// (`DensePeerFlags`). For trees of at most 32 angles and 4 effectors whose axes weigh alike.
std::unique_ptr<IkPeer> MakeDensePeer(const KinematicTree& tree);

/// Returns the flags that the dense peer was compiled with.
const char* DensePeerFlags();

/// The settings of the tree solvers of Orocos KDL. The defaults were the best of those tried (README.md).
struct KdlSettings {
  double damping = 0.03;       ///< λ of the damped least-squares step (TreeIkSolverVel_wdls)
  double position_weight = 5;  ///< weight of a metre against a radian
  int restarts = 0;            ///< of Newton's solver, from poses around the start
  double max_turn = 0.6;   ///< of an angle in one step, radians; the online solver's
};

/// Makes KDL's TreeIkSolverPos_NR_JL: Newton–Raphson steps, angles cut at their limits.
std::unique_ptr<IkPeer> MakeKdlNewton(const KinematicTree& tree, const KdlSettings& settings);
/// Makes KDL's TreeIkSolverPos_Online: the same steps, scaled down to the largest allowed speeds; run here until our
/// goals are met.
std::unique_ptr<IkPeer> MakeKdlOnline(const KinematicTree& tree, const KdlSettings& settings);

/// Makes Simbody's Assembler with a marker and an orientation sensor at every effector, limits by `restrictQ`.
std::unique_ptr<IkPeer> MakeSimbodyAssembler(const KinematicTree& tree, const SimbodySettings& settings);

}  // namespace etude
