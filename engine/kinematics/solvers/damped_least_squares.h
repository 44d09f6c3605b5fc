#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Damped least squares (Wampler 1986; Buss and Kim 2005), the method one would use today. Minimises
///   Σ_e [ position_weight · (|P_d − P_c| / 30 cm)² + Σ_k axis_weights_k · |u_kd − u_kc|² ]
/// over the angles with Gauss–Newton steps (JᵀJ + λI) Δq = Jᵀ r. The damping follows Marquardt: λ starts at 10⁻², is
/// divided by 5 after a step that lowers the sum, multiplied by 5 (and the step undone) after one that does not. Each
/// angle by itself moves by at most 0.6 rad a step and stops at its limits. `IkOptions::weights` and `refresh`
/// do not apply. Stalled also when a step lowers the sum by less than 10⁻⁶ of it. One iteration is one attempted step;
/// each costs one forward-kinematics pass.
IkSolution SolveDampedLeastSquares(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

}  // namespace etude
