#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The derivative of every end effector's pose with respect to every angle. Each degree of freedom has one column, with
/// six numbers per effector in the tree's order: the derivative of its position (∂p/∂q, metres per radian, world), then
/// its rotation vector per radian (world). A vector u that is fixed to the effector changes by ω × u. The entries are 0
/// if the angle does not move the effector.
struct TreeJacobian {
  static constexpr int kPerEffector = 6;

  int rows = 0;                ///< kPerEffector times the number of effectors
  std::vector<double> values;  ///< entries of the matrix, rows × degrees of freedom, column by column

  std::span<const double> column(int dof) const {
    return {values.data() + static_cast<std::size_t>(dof) * rows, static_cast<std::size_t>(rows)};
  }
};

/// Computes the Jacobian at `frames`, the coordinate frames of the joints of `tree`. The memory of `out` is reused from
/// call to call.
void ComputeJacobian(const KinematicTree& tree, const TreeFrames& frames, TreeJacobian& out);

/// A position error of this many metres counts as much as an axis error of one radian, in all solvers that minimise a
/// sum of squares.
inline constexpr double kPositionScale = 0.30;

/// The targets of a problem, linearised at a pose: to first order, angle changes dq meet the targets if J dq = e. A
/// position has three rows, in units of 0.30 m; the three axes together have up to three rows, in radians, about the
/// effector's own axes. All rows are multiplied by the square root of their weight. With the position P and the axes
/// u_k of an effector (d: desired, c: current), |e|² to first order is therefore
///     Σ_e [ position_weight · (|P_d − P_c| / 0.30 m)² + Σ_k axis_weights_k · |u_kd − u_kc|² ].
/// Positions and axes of weight 0 have no rows. All solvers that use a Jacobian share this class.
class LinearTargets {
 public:
  LinearTargets(const KinematicTree& tree, std::span<const EffectorTarget> targets);

  /// Computes residuals and Jacobian at the pose whose coordinate frames are `frames`.
  void Build(const TreeFrames& frames);

  int rows() const { return static_cast<int>(residuals_.size()); }
  int columns() const { return tree_.dof_count(); }
  /// Returns J, column by column: rows() numbers for each degree of freedom.
  std::span<const double> jacobian() const { return jacobian_; }
  /// Returns the residuals e, rows() numbers.
  std::span<const double> residuals() const { return residuals_; }

  /// Returns the sum that |e|² approximates (see the description of this class), computed exactly at `frames`.
  double Cost(const TreeFrames& frames) const;

 private:
  /// One row of J: the change of an effector's position along a world vector, or of its rotation about this vector.
  struct Row {
    int first = 0;  ///< first of three rows of the tree's Jacobian: an effector's position or rotation vector
    glm::dvec3 along{0};
  };

  const KinematicTree& tree_;
  std::span<const EffectorTarget> targets_;
  TreeJacobian all_;
  std::vector<Row> picked_;
  std::vector<double> jacobian_, residuals_;
};

/// Maximum change of an angle in one step, radians. Beyond it the linearisation is poor.
inline constexpr double kMaxTurn = 0.6;

/// Sets `moved` to `angles` + `step`, clamped to `ranges`; `moved` may be the memory of `angles`. Returns the largest
/// change, radians.
double MoveWithin(std::span<const AngleRange> ranges, std::span<const double> angles, std::span<const double> step,
                  std::vector<double>& moved);

/// Scales the step down so that no angle turns by more than `kMaxTurn`.
void Shorten(std::span<double> step);

}  // namespace etude
