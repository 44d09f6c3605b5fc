#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

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
