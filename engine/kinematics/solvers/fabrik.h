#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// FABRIK (Aristidou and Lasenby 2011): joints are points that reach forward and backward for the targets
/// (`FabrikPass`). It knows positions only; the axes of targets are not looked at and count in the errors all the same.
/// *Ours*, since points are no angles: after every pair of passes the joints, parents first, turn hinge by hinge, each
/// within its range and given where the joints before really went: first so that the tips of their own limb come as
/// near as possible to their places in the passes, without changing the twist; then again, so that all tips below do.
/// The second round makes up for hinges and limits farther out: with the first alone a wrist at its limit keeps its
/// hand from the target; with the second alone it takes twice the steps and solves three problems of four. The next
/// passes begin with that pose, and errors are measured there: nothing counts as reached that the angles do not reach.
/// A limb in line with its target stays so (figure 3.8): points on a line reach along it only. `IkOptions::weights` and
/// `refresh` do not apply. One iteration is one pair of passes with its rounds; each costs one forward-kinematics pass.
IkSolution SolveFabrik(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

}  // namespace etude
