#pragma once

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// *Ours*, the default solver. Of all poses that meet the targets within the limits it looks for the one nearest to the
/// start: hidden angles, which no target sees, stay where they were. In turn, until the targets are met:
///
/// 1. `tuning.first_sweeps` sweeps of coordinate descent;
/// 2. Gauss–Newton steps pulled towards the start (gauss_newton_step.h), with damping in proportion to the squared
///    residual: far away a step is careful, so that few angles run into their limits, and near the targets convergence
///    is quadratic;
/// 3. the same without the pull, where it has led into a corner: Levenberg–Marquardt steps, which never make it worse;
/// 4. from other poses around the start, two sweeps and such steps again, twenty times unless the targets are out of
///    any pose's reach;
/// 5. from the nearest pose of all, such steps until it stays put: the answer where targets cannot be met.
///
/// Nearly always the second is the last. With few iterations 2 and 3 give up sooner, so that a solver which is caught
/// in a corner of the limits gets out of it within some frames of a motion. One iteration is one sweep or one step; a
/// trace can jump where 4 and 5 begin, and without convergence the solution is the nearest pose of all, not the last
/// one of the trace. The sweeps' weights are `adaptive-power`.
IkSolution SolveGaussNewton(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

}  // namespace etude
