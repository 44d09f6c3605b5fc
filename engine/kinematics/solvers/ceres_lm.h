#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The Levenberg–Marquardt method of Ceres Solver, the general-purpose solver to beat, as fast as we could make it
/// (bench/micro/README.md says what was tried). Minimises what `damped-least-squares` minimises,
///   Σ_e [ position_weight · (|P_d − P_c| / 30 cm)² + Σ_k axis_weights_k · |u_kd − u_kc|² ],
/// by steps (JᵀJ + I / radius) dq = −Jᵀr with an analytic Jacobian; the radius begins at `IkTuning::first_radius`.
/// Steps may raise the sum for a while. Limits are Ceres's bounds. `IkOptions::weights` and `refresh` do not apply. One
/// iteration is one attempted step. Stalled also when a step lowers the sum by less than 10⁻⁹ of it.
IkSolution SolveCeresLm(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

}  // namespace etude
