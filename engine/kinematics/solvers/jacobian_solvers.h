#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "engine/kinematics/tree.h"

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

struct JacobianTransposeOptions {
  /// Multiplies the step length that is best to first order; below 2 the error still falls to first order. One is the
  /// method as it is known. It zigzags, as steepest descent with exact steps does; shorter steps avoid that (Raydan and
  /// Svaiter 2002): of 200 starts off by 15°, 0.5 solves 82 % (poses of half the joints' ranges) or 57 % (of the whole)
  /// to 10⁻³ cm and 10⁻³° within 2,000 steps, where 1 and more solve none. Set it to 0.5 to see how good the idea can
  /// be.
  double gain = 1;
};

/// Solves by the Jacobian's transpose in place of its inverse (Wolovich and Elliott 1984; paper B, section 3.5): the
/// errors dX pull at the limbs like forces, and every angle yields to its torque, ΔΘ = α JᵀdX. *Ours*: the step length
///     α = gain · ⟨dX, JJᵀdX⟩ / ⟨JJᵀdX, JJᵀdX⟩
/// makes |dX − J ΔΘ| least for a gain of 1 (Buss 2004), and to first order every gain between 0 and 2 makes it fall.
/// Angles at an end of their range whose torque points out of it take no part; no step turns an angle
/// by more than 0.6 rad; stepped angles are clamped. Cheap steps, but thousands of them: errors that the limbs feel
/// weakly fade slowly. Stalls where JᵀdX = 0, as in a limb stretched towards its target (figure 3.8).
/// `IkOptions::weights` and `refresh` do not apply. One iteration is one step; each costs one forward-kinematics pass.
IkSolution SolveJacobianTranspose(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                  const JacobianTransposeOptions& own = {});

struct JacobianPinvOptions {
  /// The damping μ of J⁺ = Jᵀ(JJᵀ + μI)⁻¹. Zero is paper B's formula, which solves 99.5 % of 200 starts off by 15°
  /// (poses of half the joints' ranges) to 10⁻³ cm and 10⁻³°. A damped J⁺ no longer takes the whole effect of the
  /// preferred posture on the effectors away, so that steps come to rest beside the targets: μ = 10⁻³ solves none of
  /// them. Set it to 10⁻⁶, which costs nothing, where JJᵀ is singular at every pose, as of limbs that cannot leave a
  /// plane.
  double damping = 0;
};

/// Solves by the pseudo-inverse with a preferred posture for what the targets leave open (paper B, equations 3.5
/// and 3.7):
///     dΘ = J⁺dX + (I − J⁺J) dZ,   J⁺ = Jᵀ(JJᵀ + μI)⁻¹,   dZ = Θ₀ − Θ
/// *Ours*: the preferred posture is the start Θ₀; μ is zero in the paper; no step turns an angle by more than 0.6 rad;
/// limits by clamping the stepped angles, as in the paper. Nothing promises that the error falls: near a singularity,
/// and where limits bind, it may rise, and an angle that is clamped is not made up for by others. Where
/// JJᵀ is singular (a stretched limb, figure 3.8) the formula has no value (`DampedInverse`); the solver stalls there
/// with the angles it has. `IkOptions::weights` and `refresh` do not apply. One iteration is one step; each costs one
/// forward-kinematics pass.
IkSolution SolveJacobianPinv(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                             const JacobianPinvOptions& own = {});

struct DampedLeastSquaresOptions {
  /// The damping λ of the first step; Marquardt's choice (1963). λ follows the steps' success, so that what is solved
  /// hardly depends on it (93 to 96 % of 200 starts off by 15° from 10⁻⁴ to 1), but the answer does: from 1 hidden
  /// angles end 0.44 of the noise from the truth, from 10⁻⁴ 0.71. Raise it where the answer shall stay near the start.
  double first_damping = 1e-2;
  /// The way in which a step keeps to the limits. Clamped is what most who write this method do, and what
  /// `damped-least-squares` always was here. It is slow along the limits, since other angles make up for one that was
  /// clamped only in later steps: of 200 starts off by 15° (poses of the joints' whole ranges) it solves 96 % to
  /// 10⁻³ cm and 10⁻³°, in 28 steps at the median, the active set all, in 6 (`damped-least-squares-active-set`).
  Bounds bounds = Bounds::kClamped;
};

/// Solves by damped least squares (Wampler 1986; Buss and Kim 2005), the method that most would use today; who writes
/// it anew should take its active set, or `SolveLevenbergMarquardt`. Minimises
///   Σ_e [ position_weight · (|P_d − P_c| / 30 cm)² + Σ_k axis_weights_k · |u_kd − u_kc|² ]
/// over the angles with Gauss–Newton steps (JᵀJ + λI) Δq = Jᵀ r. The damping follows Marquardt: λ is
/// divided by 5 after a step that lowers the sum, multiplied by 5 (and the step undone) after one that does not.
/// `Bounds::kClamped`: each angle by itself moves by at most 0.6 rad a step and stops at its limits. `kActiveSet`:
/// angles that would leave their limits are fixed there and the step is solved anew for the others (Baerlocher and
/// Boulic 2004; here the set is the optimal one, `DampedInverse::StepWithin`), and the whole step is shortened to 0.6
/// rad. `IkOptions::weights` and `refresh` do not apply. Stalled also when a step lowers the sum by less than 10⁻⁶ of
/// it. One iteration is one attempted step; each costs one forward-kinematics pass.
IkSolution SolveDampedLeastSquares(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const DampedLeastSquaresOptions& own = {});

struct LevenbergMarquardtOptions {
  /// The damping of the first step as a share of the sum of squares there. From starts off by 15°, 0.1, 0.3 and 1 take
  /// 4.9, 5.1 and 5.6 steps (means of 400, poses of the joints' whole ranges) and end 0.354, 0.351 and 0.351 of the
  /// noise from the truth; from starts off by 30°, 0.3 takes the fewest. A damping that knows nothing of the residual
  /// (0.1, 0.3, 1) takes 6.7, 7.4 and 8.3. Raise it where the answer shall stay near the start.
  double damping_share = 0.3;
};

/// Solves by the Levenberg–Marquardt method (Levenberg 1944; Marquardt 1963), dense, with limits as a projected active
/// set: what a good engineer would write today for this problem, and the strongest rival of `gauss-newton`. Minimises
/// what `damped-least-squares` minimises,
///   Σ_e [ position_weight · (|P_d − P_c| / 30 cm)² + Σ_k axis_weights_k · |u_kd − u_kc|² ],
/// by the best step within the ranges, argmin |J dq − e|² + μ |dq|², whose angles at an end of their range are fixed
/// where the gradient pushes them out of it (Bertsekas 1982; `DampedInverse::StepWithin`). The damping μ is the sum of
/// squares (Sugihara 2011), so that convergence near the targets is quadratic, times a factor that follows the ratio of
/// what a step gains to what it promised (Nielsen 1999): down to a third after a good step; doubled, then quadrupled
/// and so on after steps that would raise the sum, which are undone. No step turns an angle by more than 0.6 rad.
/// Marquardt's scaling by the diagonal of JᵀJ was tried: 5.5 to 7.5 steps where the identity takes 5.1, and hidden
/// angles end 0.41 instead of 0.35 of the noise from the truth.
///
/// A descent is stuck when six steps (a fifth of the iterations allowed, where they are few) have not brought the sum
/// down to 0.7 of what it was. Then come restarts from other poses around the start (`ScatterAround`), twenty unless
/// the targets are out of any pose's reach, the same that `gauss-newton` begins at; and last, from the pose of the
/// least sum, steps until they gain next to nothing: the answer where targets cannot be met.
///
/// `IkOptions::weights` and `refresh` do not apply. One iteration is one attempted step; each costs one
/// forward-kinematics pass, a restart one more. A trace can jump where a restart begins.
IkSolution SolveLevenbergMarquardt(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const LevenbergMarquardtOptions& own = {});

}  // namespace etude
