#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Cyclic coordinate descent as paper B describes it (sections 3.6 and 3.7): `IkOptions` chooses joint limits,
/// angle-change tolerance and weights. One iteration is one sweep over all joints, one forward-kinematics pass.
IkSolution SolveCcd(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

/// *Ours*: the same with every joint of two or three degrees of freedom treated as a row of hinges.
IkSolution SolveCcdHinges(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

}  // namespace etude
