#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/damped_inverse.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct JacobianPinvOptions {
  /// μ of J⁺ = Jᵀ(JJᵀ + μI)⁻¹. Zero is paper B's formula, which solves 99.5 % of 200 starts off by 15° (poses of half
  /// the joints' ranges) to 10⁻³ cm and 10⁻³°. A damped J⁺ no longer takes the whole effect of the preferred posture on
  /// the effectors away, so that steps come to rest beside the targets: μ = 10⁻³ solves none of them. Set it to 10⁻⁶,
  /// which costs nothing, where JJᵀ is singular at every pose, as of limbs that cannot leave a plane.
  double damping = 0;
  /// How a step keeps to the limits. The paper clamps the stepped angles: of 200 starts off by 15° it solves 99.5 %
  /// (poses of half the joints' ranges) and 44 % (of the whole) to 10⁻³ cm and 10⁻³°, the active set 100 and 96 %
  /// (`jacobian-pinv-active-set`).
  Bounds bounds = Bounds::kClamped;
};

/// The pseudo-inverse with a preferred posture for what the targets leave open (paper B, equations 3.5 and 3.7):
///     dΘ = J⁺dX + (I − J⁺J) dZ,   J⁺ = Jᵀ(JJᵀ + μI)⁻¹,   dZ = Θ₀ − Θ
/// *Ours*: the preferred posture is the start Θ₀; μ is zero in the paper; no step turns an angle by more than 0.6 rad;
/// limits by clamping the stepped angles, as in the paper, or by an active set: angles that would leave their limits
/// are fixed there, and the others meet the targets as well as they can (Flacco, De Luca and Khatib 2012, "saturation
/// in the null space"; here the set is the optimal one, `DampedInverse::StepWithin`). Where no step within the limits
/// meets the targets to first order, or the set does not settle, the active set's step is damped by at least 0.1: from
/// starts off by 15°, 0.03 solves as many in more steps, 0.3 and 1 fewer. Nothing promises that the error falls: near a
/// singularity, and where limits bind, it may rise, and an angle that is clamped is not made up for by others. Where
/// JJᵀ is singular (a stretched limb, figure 3.8) the formula has no value (`DampedInverse`); the solver stalls there
/// with the angles it has. `IkOptions::weights` and `refresh` do not apply. One iteration is one step; each costs one
/// forward-kinematics pass.
IkSolution SolveJacobianPinv(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                             const JacobianPinvOptions& own = {});

}  // namespace etude
