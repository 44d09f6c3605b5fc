#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct JacobianTransposeOptions {
  /// Multiplies the step length that is best to first order; below 2 the error still falls to first order. One is the
  /// method as it is known. It zigzags, as steepest descent with exact steps does; shorter steps avoid that (Raydan and
  /// Svaiter 2002): of 200 starts off by 15°, 0.5 solves 82 % (poses of half the joints' ranges) or 57 % (of the whole)
  /// to 10⁻³ cm and 10⁻³° within 2,000 steps, where 1 and more solve none. Set it to 0.5 to see how good the idea can
  /// be.
  double gain = 1;
};

/// The Jacobian's transpose in place of its inverse (Wolovich and Elliott 1984; paper B, section 3.5): the errors dX
/// pull at the limbs like forces, and every angle yields to its torque, ΔΘ = α JᵀdX. *Ours*: the step length
///     α = gain · ⟨dX, JJᵀdX⟩ / ⟨JJᵀdX, JJᵀdX⟩
/// makes |dX − J ΔΘ| least for a gain of 1 (Buss 2004), and to first order every gain between 0 and 2 makes it fall.
/// Angles at an end of their range whose torque points out of it take no part; no step turns an angle
/// by more than 0.6 rad; stepped angles are clamped. Cheap steps, but thousands of them: errors that the limbs feel
/// weakly fade slowly. Stalls where JᵀdX = 0, as in a limb stretched towards its target (figure 3.8).
/// `IkOptions::weights` and `refresh` do not apply. One iteration is one step; each costs one forward-kinematics pass.
IkSolution SolveJacobianTranspose(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                  const JacobianTransposeOptions& own = {});

}  // namespace etude
