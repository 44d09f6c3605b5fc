#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// *Ours*: the sweeps of `ccd-hinges`, extrapolated (anderson_mixing.h) from the last `IkTuning::memory` of them. Paper
/// B settles one joint after the other, so errors creep along the limbs; what creeps can be foretold. An angle enters
/// as x = tan((q − middle of its range) / 2), which costs no trigonometry. An extrapolation that raises
/// Σ w_p e² + Σ w_o |u_c − u_d|², by the weights of its sweep, is dropped for what the sweep itself found. One
/// iteration is one sweep; it costs one forward-kinematics pass, or two when its extrapolation was dropped.
IkSolution SolveCcdAnderson(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

}  // namespace etude
