#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The derivatives of every end effector by every angle. Column by column, one per degree of freedom: six numbers for
/// each effector in the tree's order, first what its position gains (∂p/∂q, metres per radian, x y z of the world),
/// then about which vector it turns (the rotation vector per radian, in the world). So any vector u fixed to the
/// effector gains ω × u. Zeros where an angle does not lead to an effector.
struct TreeJacobian {
  static constexpr int kPerEffector = 6;

  int rows = 0;                ///< kPerEffector times the number of effectors
  std::vector<double> values;  ///< rows × degrees of freedom, column after column

  std::span<const double> column(int dof) const {
    return {values.data() + static_cast<std::size_t>(dof) * rows, static_cast<std::size_t>(rows)};
  }
};

/// Computes the Jacobian at `frames`, which are those of `tree` in some pose. `out` keeps its memory from call to call.
void ComputeJacobian(const KinematicTree& tree, const TreeFrames& frames, TreeJacobian& out);

/// The metres that count as much as one radian, in all solvers that minimise a sum of squares.
inline constexpr double kPositionScale = 0.30;

/// The targets of a problem to first order around a pose: angle changes dq meet them when J dq = e. Three rows for a
/// position, in units of 0.30 m; up to three for the axes, in radians, about the effector's own axes; all times the
/// root of their weight, so that |e|² is to first order
///     Σ_e [ position_weight · (|P_d − P_c| / 0.30 m)² + Σ_k axis_weights_k · |u_kd − u_kc|² ].
/// What has no weight has no row. Shared by the solvers that work with Jacobians.
class LinearTargets {
 public:
  LinearTargets(const KinematicTree& tree, std::span<const EffectorTarget> targets);

  /// Linearises the targets at `frames`.
  void Build(const TreeFrames& frames);

  int rows() const { return static_cast<int>(residuals_.size()); }
  int columns() const { return tree_.dof_count(); }
  /// J, column after column: rows() numbers for each degree of freedom.
  std::span<const double> jacobian() const { return jacobian_; }
  /// e, rows() numbers.
  std::span<const double> residuals() const { return residuals_; }

  /// Returns the sum above, without any approximation.
  double Cost(const TreeFrames& frames) const;

 private:
  /// One row: the vector of the world along or about which an effector moves.
  struct Row {
    int first = 0;  ///< of three rows of the tree's Jacobian: an effector's position, or its rotation vector
    glm::dvec3 along{0};
  };

  const KinematicTree& tree_;
  std::span<const EffectorTarget> targets_;
  TreeJacobian all_;
  std::vector<Row> picked_;
  std::vector<double> jacobian_, residuals_;
};

/// The most that any angle turns in one step, radians: beyond that, first order means little.
inline constexpr double kLargestTurn = 0.6;

/// Sets `moved` to `angles` + `step`, each clamped to its range; it may be the angles' own memory. Returns the largest
/// change, radians.
double MoveWithin(std::span<const AngleRange> ranges, std::span<const double> angles, std::span<const double> step,
                  std::vector<double>& moved);

/// Scales the whole step down so that no angle turns by more than `kLargestTurn`.
void Shorten(std::span<double> step);

}  // namespace etude
