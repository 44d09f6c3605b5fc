#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// *Ours*, the default solver: some sweeps of coordinate descent, which come near from anywhere, then Gauss–Newton
/// steps that meet the targets and stay as close to the start angles as these allow (null_space_step.h). Where the
/// steps get stuck, more sweeps and steps follow in turns, every other time without the pull towards the start. The
/// sweeps' weights are `adaptive-power`; one iteration is one sweep or one step.
IkSolution SolveNullSpace(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

}  // namespace etude
