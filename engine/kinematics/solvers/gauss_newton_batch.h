#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_batch.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/batch_sweep.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Solves many problems of one tree at once by `gauss-newton`, each in a lane of the CPU's vectors from its start to
/// its last restart; a lane whose problem is done takes the next one. What comes out depends neither on the width of
/// the vectors nor on the other problems. Pairs of a position and an axis that nearly meet the goals, restarts' poses
/// and their sweeps are left to scalar code; all else is done in lanes.
/// - `kDouble`: every solution is that of `SolveGaussNewton`, to the last bit.
/// - `kFloat`: twice as many lanes. Goals are nine tenths of what is asked for, so that those asked for are met in
///   double; damping is 10⁻⁵ at least, and steps are not pulled to the start once |e|² < 10⁻⁶, where floats see no more
///   of it. A problem that floats do not solve is solved in double, from its start, and its iterations are those. Where
///   several poses meet the targets it may be another one that is found than in double. Not for goals below 2·10⁻⁴ cm
///   or degrees.
/// A bad problem answers kBadInput for itself; so does every problem when the tree or the options are bad.
/// `IkOptions::trace` is not filled.
IkBatchSolution SolveGaussNewtonBatch(const KinematicTree& tree, const IkBatch& problems, const IkOptions& options,
                                      Precision precision, const GaussNewtonOptions& own = {});

/// The same with a solution of its own for each problem, errors included.
std::vector<IkSolution> SolveGaussNewtonBatch(const KinematicTree& tree, std::span<const IkProblem> problems,
                                              const IkOptions& options, Precision precision,
                                              const GaussNewtonOptions& own = {});

}  // namespace etude
