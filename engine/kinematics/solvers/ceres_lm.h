#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct CeresLmOptions {
  /// The initial radius of the trust region. The default solves the most problems (README.md has the figures). Set it
  /// to 1 if speed matters: the solver then takes fewer steps and stays nearer to the start, but solves slightly fewer
  /// problems.
  double first_radius = 10;
};

/// Solves by the Levenberg–Marquardt method of Ceres Solver, a general-purpose solver, for comparison with our solvers.
/// Ceres's options are tuned for speed (bench/peers/README.md lists what was tried). The solver minimises the same sum
/// as `damped-least-squares`,
///   Σ_e [ position_weight · (|P_d − P_c| / 30 cm)² + Σ_k axis_weights_k · |u_kd − u_kc|² ],
/// by steps (JᵀJ + I / radius) dq = −Jᵀr with an analytic Jacobian; the sum may rise for some steps. Joint limits are
/// passed to Ceres as bounds. `IkOptions::weights` and `refresh` do not apply. One iteration is one attempted step. The
/// solver also stalls if a step lowers the sum by less than 10⁻⁹ of its value.
IkSolution SolveCeresLm(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                        const CeresLmOptions& own = {});

}  // namespace etude
