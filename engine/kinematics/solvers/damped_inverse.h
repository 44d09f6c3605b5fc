#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {

/// The pseudo-inverse J⁺ = Jᵀ(JJᵀ + μI)⁻¹ of paper B, equation 3.5, damped by μ; with μ it equals (JᵀJ + μI)⁻¹Jᵀ, and
/// is the smaller of the two to solve, since a body has more angles than its targets have numbers.
class DampedInverse {
 public:
  /// Takes J and e of `linear`, for steps with any damping.
  void Build(const LinearTargets& linear);

  /// Sets `step` to J⁺e + (I − J⁺J) preferred (equation 3.7; `preferred` leads to the preferred posture), one number
  /// per degree of freedom. False, and `step` is of no use, when JJᵀ + μI is singular: its smallest pivot not above
  /// 10⁻¹² of its largest.
  bool Step(double damping, std::span<const double> preferred, std::vector<double>& step);

 private:
  int rows_ = 0, columns_ = 0;
  std::vector<double> jacobian_, residuals_;
  std::vector<double> gram_, damped_;  ///< JJᵀ and JJᵀ + μI, rows_ × rows_
};

}  // namespace etude
