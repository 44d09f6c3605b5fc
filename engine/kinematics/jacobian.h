#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

/// How every end effector moves with every angle. Column by column, one per degree of freedom: six numbers for each
/// effector in the tree's order, first what its position gains (∂p/∂q, metres per radian, x y z of the world), then
/// about which vector it turns (the rotation vector per radian, in the world). So any vector u fixed to the effector
/// gains ω × u. Zeros where an angle does not lead to an effector.
struct TreeJacobian {
  static constexpr int kPerEffector = 6;

  int rows = 0;                ///< kPerEffector times the number of effectors
  std::vector<double> values;  ///< rows × degrees of freedom, column after column

  std::span<const double> column(int dof) const {
    return {values.data() + static_cast<std::size_t>(dof) * rows, static_cast<std::size_t>(rows)};
  }
};

/// The Jacobian at `frames`, which are those of `tree` in some pose. `out` keeps its memory from call to call.
void ComputeJacobian(const KinematicTree& tree, const TreeFrames& frames, TreeJacobian& out);

}  // namespace etude
