#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct CeresLmOptions {
  /// The radius of the trust region it begins with. Ten solves the most: 96.5 % of 200 starts off by 15° (poses of the
  /// joints' whole ranges) to 10⁻³ cm and 10⁻³°, where 1 solves 95 %, 100 93 % and Ceres's own 10⁴ 86.5 %. At 1 it
  /// takes fewer steps there (57 instead of 67) and stays nearer to the start: the radius for a race
  /// (bench/micro/README.md).
  double first_radius = 10;
};

/// Solves by the Levenberg–Marquardt method of Ceres Solver, the general-purpose solver to beat, as fast as we could
/// make it (bench/micro/README.md says what was tried). Minimises what `damped-least-squares` minimises,
///   Σ_e [ position_weight · (|P_d − P_c| / 30 cm)² + Σ_k axis_weights_k · |u_kd − u_kc|² ],
/// by steps (JᵀJ + I / radius) dq = −Jᵀr with an analytic Jacobian; steps
/// may raise the sum for a while. Limits are Ceres's bounds. `IkOptions::weights` and `refresh` do not apply. One
/// iteration is one attempted step. Stalled also when a step lowers the sum by less than 10⁻⁹ of it.
IkSolution SolveCeresLm(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                        const CeresLmOptions& own = {});

}  // namespace etude
