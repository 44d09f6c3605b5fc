#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {

/// The way in which a solver of dense linear steps keeps to the ranges of angles.
enum class Bounds {
  kClamped,    ///< `Step`, and the stepped angles are clamped: others do not make up for what is lost
  kActiveSet,  ///< `StepWithin`: angles that would leave their range are fixed at its end, and the others solved for
};

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

  /// Sets `step` to the best one within `ranges`, in which `angles` are now:
  ///     argmin |J dq − e|² + μ |dq − preferred|²   subject to   lower ≤ angles + dq ≤ upper.
  /// By duality dq = clamp(preferred + Jᵀy), where J dq + μ y = e: a piecewise linear equation of as many unknowns as
  /// targets have numbers. Newton's method on it is the primal-dual active set (Hintermüller, Ito and Kunisch 2002): y
  /// is solved for with some angles fixed at an end of their range, none at first, and then each is fixed where
  /// preferred + Jᵀy leads beyond that end, and free where it does not. (To begin with the last step's set takes more
  /// passes.) It may take four passes; one and a half is the mean of steps with the damping of `levenberg-marquardt`,
  /// which settle nearly all, and more hardly help the others. The answer is within the ranges always, and the optimum
  /// when the set has settled (`is_exact`): then the conditions of Karush, Kuhn and Tucker hold. False as above, for
  /// the angles that are free.
  bool StepWithin(double damping, std::span<const double> preferred, std::span<const double> angles,
                  std::span<const AngleRange> ranges, std::vector<double>& step);

  /// Returns whether the last step of `StepWithin` is the optimum.
  bool is_exact() const { return is_exact_; }

  /// Returns |e|² − |e − J step|², by which the sum of squares falls to first order.
  double Gain(std::span<const double> step) const;

 private:
  bool SolveDuals(double damping);

  int rows_ = 0, columns_ = 0;
  std::vector<double> jacobian_, residuals_;
  std::vector<double> gram_, damped_;  ///< JJᵀ and JJᵀ + μI, rows_ × rows_; the lower triangle counts
  std::vector<double> duals_;          ///< y
  std::vector<signed char> sides_;     ///< of each angle: −1 fixed at its lower end, 0 free, 1 at its upper one
  bool is_exact_ = false;
};

}  // namespace etude
