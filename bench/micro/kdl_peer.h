#pragma once

#include <memory>

#include "bench/micro/ik_peer.h"

namespace etude {

/// The settings of the tree solvers of Orocos KDL. The defaults were the best of those tried (README.md).
struct KdlSettings {
  double damping = 0.03;       ///< λ of the damped least-squares step (TreeIkSolverVel_wdls)
  double position_weight = 5;  ///< weight of a metre against a radian
  int restarts = 0;            ///< of Newton's solver, from poses around the start
  double largest_turn = 0.6;   ///< of an angle in one step, radians; the online solver's
};

/// TreeIkSolverPos_NR_JL: Newton–Raphson steps, angles cut at their limits.
std::unique_ptr<IkPeer> MakeKdlNewton(const KinematicTree& tree, const KdlSettings& settings);
/// TreeIkSolverPos_Online: the same steps, scaled down to the largest allowed speeds; run here until our goals are met.
std::unique_ptr<IkPeer> MakeKdlOnline(const KinematicTree& tree, const KdlSettings& settings);

}  // namespace etude
