#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/damped_inverse.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct DampedLeastSquaresOptions {
  /// The damping λ of the first step; Marquardt's choice (1963). λ follows the steps' success, so that what is solved
  /// hardly depends on it (93 to 96 % of 200 starts off by 15° from 10⁻⁴ to 1), but the answer does: from 1 hidden
  /// angles end 0.44 of the noise from the truth, from 10⁻⁴ 0.71. Raise it where the answer shall stay near the start.
  double first_damping = 1e-2;
  /// How a step keeps to the limits. Clamped is what most who write this method do, and what `damped-least-squares`
  /// always was here; it crawls along the limits, where others make up for an angle's lost share only step by step: of
  /// 200 starts off by 15° (poses of the joints' whole ranges) it solves 96 % to 10⁻³ cm and 10⁻³°, in 28 steps at the
  /// median, the active set all, in 6 (`damped-least-squares-active-set`).
  Bounds bounds = Bounds::kClamped;
};

/// Damped least squares (Wampler 1986; Buss and Kim 2005), the method that most would use today; who writes it anew
/// should take its active set, or `SolveLevenbergMarquardt`. Minimises
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

}  // namespace etude
