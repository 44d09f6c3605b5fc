#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The pseudo-inverse with a wish for what the targets leave open (paper B, equations 3.5 and 3.7):
///     dΘ = J⁺dX + (I − J⁺J) dZ,   J⁺ = Jᵀ(JJᵀ + μI)⁻¹,   dZ = Θ₀ − Θ
/// *Ours*: what is wished is to stay near the start Θ₀; μ is `IkTuning::pinv_damping`, zero in the paper; no step
/// turns an angle by more than 0.6 rad; limits by clamping the stepped angles. Nothing promises that the error falls:
/// near a singularity, and where limits bind, it may rise, and an angle that is clamped is not made up for by others.
/// Where JJᵀ is singular (a stretched limb, figure 3.8) the formula has no value (`DampedInverse`); the solver stalls
/// there with the angles it has. `IkOptions::weights` and `refresh` do not apply. One iteration is one step; each costs
/// one forward-kinematics pass.
IkSolution SolveJacobianPinv(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

}  // namespace etude
