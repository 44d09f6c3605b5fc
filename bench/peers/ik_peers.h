#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/peers/simbody_model.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct IkPeerAnswer {
  std::vector<double> angles;
  int steps = -1;  ///< steps of the solver; −1 = unknown
};

/// Inverse kinematics by another library. The library's model is built once and holds everything that does not depend
/// on a problem. The root of the tree is fixed at its place in StandingState.
class IkPeer {
 public:
  virtual ~IkPeer() = default;

  /// Returns the effectors' frames by the library's own forward kinematics. The frames show whether the library's model
  /// equals the tree.
  virtual std::vector<LimbFrame> Effectors(std::span<const double> angles) = 0;

  /// Solves from `problem.start`. The library stops at `position_goal` and `axis_goal` of `options`, as far as its stop
  /// criteria can express them.
  virtual IkPeerAnswer Solve(const IkProblem& problem, const IkOptions& options) = 0;
};

/// Makes a dense implementation of the algorithm of Etude's `levenberg-marquardt` (active set, same restarts), written
/// for speed alone. It has arrays of fixed size, no input checks and no trace, and is compiled with its own flags. It
/// supports trees of at most 32 angles and 4 effectors with equal axis weights.
std::unique_ptr<IkPeer> MakeDensePeer(const KinematicTree& tree);

const char* DensePeerFlags();

/// The settings of the tree solvers of Orocos KDL. The defaults were the best settings of those tried (README.md).
struct KdlSettings {
  double damping = 0.03;       ///< λ of the damped least-squares step (TreeIkSolverVel_wdls)
  double position_weight = 5;  ///< weight of an error of 1 m relative to one of 1 rad
  int restarts = 0;            ///< number of restarts of the Newton solver, from poses around the start
  double max_turn = 0.6;       ///< largest change of an angle per step of the online solver, radians
};

/// Makes KDL's TreeIkSolverPos_NR_JL: Newton–Raphson steps with angles clamped to their limits.
std::unique_ptr<IkPeer> MakeKdlNewton(const KinematicTree& tree, const KdlSettings& settings);
/// Makes KDL's TreeIkSolverPos_Online. It takes the Newton–Raphson steps of MakeKdlNewton, scaled down to maximum
/// speeds, until the goals of IkOptions are met.
std::unique_ptr<IkPeer> MakeKdlOnline(const KinematicTree& tree, const KdlSettings& settings);

/// Makes Simbody's Assembler with a marker and an orientation sensor at every effector; `restrictQ` sets the limits.
std::unique_ptr<IkPeer> MakeSimbodyAssembler(const KinematicTree& tree, const SimbodySettings& settings);

}  // namespace etude
