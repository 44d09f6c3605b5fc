#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The way in which a solver of dense linear steps keeps angles within their ranges.
enum class Bounds {
  kClamped,  ///< make an unlimited step (`Step`), then clamp the angles; free angles do not compensate for this
  /// Solve for the best step within the ranges (`StepWithin`): angles that would leave their range are fixed at its
  /// end, and the other angles compensate.
  kActiveSet,
};

/// The damped pseudo-inverse J⁺ = Jᵀ(JJᵀ + μI)⁻¹ of paper B, equation 3.5. For μ > 0 it equals (JᵀJ + μI)⁻¹Jᵀ, but the
/// matrix is smaller, because a body has more angles than its targets have rows.
class DampedInverse {
 public:
  /// Copies J and e of `linear` and forms JJᵀ, for steps with any damping.
  void Build(const LinearTargets& linear);

  /// Sets `step` to J⁺e + (I − J⁺J) preferred (equation 3.7), one number per degree of freedom; `preferred` is the
  /// change that leads to the preferred posture. Returns false, with a meaningless `step`, if JJᵀ + μI is singular: its
  /// smallest pivot is not above 10⁻¹² of its largest.
  bool Step(double damping, std::span<const double> preferred, std::vector<double>& step);

  /// Sets `step` to the best step that stays within `ranges`; `angles` must lie within `ranges`:
  ///     argmin |J dq − e|² + μ |dq − preferred|²   subject to   lower ≤ angles + dq ≤ upper.
  /// By duality dq = clamp(preferred + Jᵀy) with J dq + μ y = e, a piecewise linear equation with as many unknowns as
  /// J has rows. It is solved by Newton's method, which here is the primal-dual active set method (Hintermüller, Ito
  /// and Kunisch 2002): solve for y with some angles fixed at an end of their range, none at first; then fix every
  /// angle whose preferred + Jᵀy is beyond an end of its range at that end, and free the others. (Starting from the
  /// active set of the last step takes more passes.) At most four passes are made; with the damping of
  /// `levenberg-marquardt` the mean is 1.5 passes. Nearly every active set settles within four passes; more passes
  /// would settle few of the others. The answer always lies within the ranges. It is the optimum if the active set
  /// has settled (`is_exact`), because the conditions of Karush, Kuhn and Tucker then hold. Returns false, like
  /// `Step`, if the matrix of the free angles is singular.
  bool StepWithin(double damping, std::span<const double> preferred, std::span<const double> angles,
                  std::span<const AngleRange> ranges, std::vector<double>& step);

  /// Returns true if the last step of `StepWithin` is the optimum.
  bool is_exact() const { return is_exact_; }

  /// Returns |e|² − |e − J step|², the reduction of the sum of squares that the linearisation predicts.
  double Gain(std::span<const double> step) const;

 private:
  bool SolveDuals(double damping);

  int rows_ = 0, columns_ = 0;
  std::vector<double> jacobian_, residuals_;
  std::vector<double> gram_, damped_;  ///< JJᵀ and JJᵀ + μI, rows_ × rows_; only the lower triangle is used
  std::vector<double> duals_;          ///< y of `StepWithin`
  std::vector<signed char> sides_;     ///< for each angle: −1 if fixed at its minimum, 1 at its maximum, 0 if free
  bool is_exact_ = false;
};

struct JacobianTransposeOptions {
  /// The factor on the step length that is optimal to first order. To first order, every factor between 0 and 2 lowers
  /// the error. The default 1 is the usual method. Its steps zigzag like those of steepest descent with exact line
  /// search; shorter steps avoid that (Raydan and Svaiter 2002). Set it to 0.5 to see the method at its best (README.md
  /// has the figures).
  double gain = 1;
};

/// Solves by the transpose of the Jacobian instead of its inverse (Wolovich and Elliott 1984; paper B, section 3.5):
/// the errors dX act on the limbs like forces, and every angle follows its torque, ΔΘ = α JᵀdX. The step length is
/// *ours*:
///     α = gain · ⟨dX, JJᵀdX⟩ / ⟨JJᵀdX, JJᵀdX⟩
/// With a gain of 1 it minimises |dX − J ΔΘ| (Buss 2004); to first order, every gain between 0 and 2 reduces it. Angles
/// at an end of their range are left out if their torque points out of the range; no step turns an angle by more than
/// 0.6 rad; new angles are clamped. Steps are cheap, but thousands are needed, because errors to which J is insensitive
/// decrease slowly. The solver stalls if JᵀdX = 0, as for a limb stretched towards its target (paper B, figure 3.8).
/// `IkOptions::weights` and `refresh` do not apply. One iteration is one step and costs one forward-kinematics pass.
IkSolution SolveJacobianTranspose(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                  const JacobianTransposeOptions& own = {});

struct JacobianPinvOptions {
  /// The damping μ of J⁺ = Jᵀ(JJᵀ + μI)⁻¹. The default 0 is paper B's formula. With μ > 0, the null-space term also
  /// moves the effectors, so steps end away from the targets; 10⁻³ is already too much. Set it to 10⁻⁶, which does no
  /// harm, if JJᵀ is singular at every pose, as for limbs that cannot leave a plane.
  double damping = 0;
};

/// Solves by the pseudo-inverse; a preferred posture determines the angles that the targets leave open (paper B,
/// equations 3.5 and 3.7):
///     dΘ = J⁺dX + (I − J⁺J) dZ,   J⁺ = Jᵀ(JJᵀ + μI)⁻¹,   dZ = Θ₀ − Θ
/// *Ours*: the preferred posture is the start Θ₀, and no step turns an angle by more than 0.6 rad. As in the paper, μ
/// is zero by default, and limits are kept by clamping the stepped angles. The error may rise near a singularity and
/// where limits are active, because other angles do not compensate for a clamped angle. If JJᵀ is singular (a stretched
/// limb, figure 3.8), the formula is undefined (`DampedInverse`), and the solver stalls with its present angles.
/// `IkOptions::weights` and `refresh` do not apply. One iteration is one step; each costs one forward-kinematics pass.
IkSolution SolveJacobianPinv(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                             const JacobianPinvOptions& own = {});

struct DampedLeastSquaresOptions {
  /// The damping λ of the first step, by default Marquardt's choice (1963). λ then adapts to the success of the steps,
  /// so the number of solved problems hardly depends on this value. A larger value keeps angles that no target
  /// determines nearer to the start: raise it if the answer should stay there (README.md has the figures).
  double first_damping = 1e-2;
  /// The way in which a step keeps the limits. Clamping is the default because most implementations of this method do
  /// it. Clamping is slow along limits, because other angles compensate for a clamped angle only in later steps.
  /// `damped-least-squares-active-set` uses the active set.
  Bounds bounds = Bounds::kClamped;
};

/// Solves by damped least squares (Wampler 1986; Buss and Kim 2005), the most common method today. A new implementation
/// should use the active set, or `SolveLevenbergMarquardt`. The method minimises
///   Σ_e [ position_weight · (|P_d − P_c| / 30 cm)² + Σ_k axis_weights_k · |u_kd − u_kc|² ]
/// over the angles with Gauss–Newton steps (JᵀJ + λI) Δq = Jᵀ r. The damping follows Marquardt: λ is divided by 5 after
/// a step that lowers the sum; a step that does not lower the sum is undone, and λ is multiplied by 5. With
/// `Bounds::kClamped`, each angle moves by at most 0.6 rad a step and is clamped to its limits. With `kActiveSet`,
/// angles that would leave their limits are fixed there, and the step is solved for the other angles (Baerlocher and
/// Boulic 2004; here `DampedInverse::StepWithin` also searches for the optimal set of fixed angles). The whole step
/// is then scaled down to at most 0.6 rad. `IkOptions::weights` and `refresh` do not apply. The solver also stalls if
/// a step lowers the sum by less than 10⁻⁶ of its value. One iteration is one attempted step and costs one
/// forward-kinematics pass.
IkSolution SolveDampedLeastSquares(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const DampedLeastSquaresOptions& own = {});

struct LevenbergMarquardtOptions {
  /// The damping of the first step as a share of the sum of squares at the start. The default needs about the fewest
  /// steps over small and large start errors. Raise it if the answer should stay near the start (README.md has the
  /// figures).
  double damping_share = 0.3;
};

/// Solves by the dense Levenberg–Marquardt method (Levenberg 1944; Marquardt 1963) with limits as a projected active
/// set. This method is the state of the art for the problem, and the strongest competitor of `gauss-newton`. It
/// minimises the same sum as `damped-least-squares`,
///   Σ_e [ position_weight · (|P_d − P_c| / 30 cm)² + Σ_k axis_weights_k · |u_kd − u_kc|² ],
/// by the best step within the ranges, argmin |J dq − e|² + μ |dq|². Angles at an end of their range are fixed if the
/// gradient pushes them out of the range (Bertsekas 1982; `DampedInverse::StepWithin`). The damping μ is the product
/// of the sum of squares, `damping_share` and a factor. The sum of squares makes convergence near the targets
/// quadratic (Sugihara 2011). The factor follows the ratio of actual to predicted reduction (Nielsen 1999): a good
/// step lowers the factor, to no less than a third of its value; a step that would raise the sum is undone and
/// multiplies the factor, the first such step by 2, the next by 4, then by 8, and so on. No step turns an angle by
/// more than 0.6 rad.
///
/// A descent is stuck if six steps (a fifth of the allowed iterations, if that is less) have not reduced the sum to 0.7
/// of its value. Then up to twenty restarts follow, from the same poses around the start that `gauss-newton` uses
/// (`ScatterAround`); there are none if no pose can reach the targets. Finally, steps from the pose of the smallest sum
/// continue until they gain almost nothing; the result is the answer if the targets cannot be met.
///
/// `IkOptions::weights` and `refresh` do not apply. One iteration is one attempted step; each costs one
/// forward-kinematics pass, a restart one more. A trace can jump where a restart begins.
IkSolution SolveLevenbergMarquardt(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const LevenbergMarquardtOptions& own = {});

}  // namespace etude
