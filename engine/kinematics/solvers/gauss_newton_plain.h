#pragma once

#include "engine/kinematics/solvers/gauss_newton.h"

namespace etude {

/// `SolveGaussNewton` one number at a time, as one would write it down: the code to read. The same answer to the last
/// bit, and the trace if one is asked for.
IkSolution SolveGaussNewtonPlainly(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const GaussNewtonOptions& own = {});

}  // namespace etude
