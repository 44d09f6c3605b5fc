#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Gauss–Newton steps towards targets that stay as near to a wanted pose as the targets allow: of all angle
/// changes dq that meet the targets to first order, the one with the least |q + dq − q₀|, by
///     dq = (q₀ − q) + Jᵀλ,   (J Jᵀ + μI) λ = e − J(q₀ − q),
/// J the targets' Jacobian, e their residuals (positions in units of 0.30 m, axes in radians). Angles that would leave
/// their range are frozen at its end and the rest is solved anew (an active set). Takes its memory when made.
class NullSpaceStep {
 public:
  NullSpaceStep(const KinematicTree& tree, std::span<const EffectorTarget> targets);

  /// Linearises at `frames`, whose `dof_axes` are filled.
  void Build(const TreeFrames& frames);

  /// The change of every angle, which keeps within `ranges`; empty when the equations cannot be solved.
  std::span<const double> Solve(std::span<const double> angles, std::span<const double> wanted,
                                std::span<const AngleRange> ranges, double damping);

 private:
  /// What one angle does to one effector: three rows of position, three of axes, in the effector's own frame.
  using Column = std::array<double, 6>;
  struct Lever {
    int dof = 0;
    Column column{};
  };

  void Freeze(int dof, double change);
  bool Factorise(double damping);

  const KinematicTree& tree_;
  std::span<const EffectorTarget> targets_;
  std::vector<std::vector<Lever>> levers_;      ///< of each effector, from the root outwards
  std::vector<std::vector<int>> effectors_of_;  ///< of each angle
  std::vector<Column> residuals_;
  std::vector<double> gram_, factor_;  ///< J Jᵀ over angles that are free, and its Cholesky factor; lower triangles
  std::vector<double> right_, change_;
  std::vector<char> is_frozen_;
  int rows_ = 0;
};

}  // namespace etude
