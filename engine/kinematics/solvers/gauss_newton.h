#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/kinematics/ik_batch.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct GaussNewtonOptions {
  /// The number of sweeps of coordinate descent before the first Gauss–Newton step. None: damped steps do better from
  /// the start than from a pose whose angles sweeps have driven into their limits. Of 200 starts off by 15° all are
  /// solved with 0 to 20 of them, in 5.3, 6.9 and 24.6 iterations with 0, 2 and 20. Raise it to compare.
  int first_sweeps = 0;
  /// The number of extra passes of a step's active set when damping is small: the null-space components of the step
  /// depend on which limits are active. Over the joints' whole ranges three take 4.27 instead of 4.49 iterations from
  /// starts off by 15°, and of 500 starts off by 2° leave 5 farther than 0.01 rad from the nearest solution instead of
  /// 16; one does most of that, six no more. Set it to 0 where a step's time counts more than its answer.
  int extra_passes = 3;
  /// The number of restarts from other poses when steps are stuck. Set it to 0 where targets that no pose meets are the
  /// rule and the start is near: every iteration then goes into the least residual around it.
  int restarts = 20;
};

/// Looks, of all poses that meet the targets within the limits, for the one nearest to the start: hidden angles, which
/// no target sees, stay where they were. *Ours*, the default solver. In turn, until the targets are met:
///
/// 1. `first_sweeps` sweeps of coordinate descent, none by default;
/// 2. Gauss–Newton steps pulled towards the start (`GaussNewtonStep`), with damping in proportion to the squared
///    residual: far away steps are short, so that few angles run into their limits, and near the targets convergence
///    is quadratic;
/// 3. the same without the pull, where it has led to limits that block: Levenberg–Marquardt steps, which never raise
///    the residual;
/// 4. `restarts` from other poses around the start, two sweeps and such steps each, none if the targets are out of any
///    pose's reach;
/// 5. from the pose of the least residual, such steps until they stall: the answer where targets cannot be met.
///
/// Nearly always the second is the last. With few iterations 2 and 3 give up sooner, so that a solver which is blocked
/// by limits gets past them within some frames of a motion. One iteration is one sweep or one step; a trace can jump
/// where 4 and 5 begin, and without convergence the solution is the pose of the least residual, not the last one of
/// the trace. The sweeps' weights are `adaptive-power`.
IkSolution SolveGaussNewton(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const GaussNewtonOptions& own = {});

/// Solves one problem of a tree after the other as `SolveGaussNewton` does. What is the tree's own, its validity and
/// the order of its joints, is looked at once, and memory is taken once. `tree` must outlive this. Use it along a
/// motion, or where problems come one by one; many at once are faster together (`SolveGaussNewtonBatch`).
class GaussNewtonSolver {
 public:
  explicit GaussNewtonSolver(const KinematicTree& tree);
  ~GaussNewtonSolver();

  /// Solves one problem. Only memory changes: an answer does not depend on what was asked before.
  IkSolution Solve(const IkProblem& problem, const IkOptions& options, const GaussNewtonOptions& own = {}) const;

 private:
  class Solver;

  const KinematicTree& tree_;
  std::unique_ptr<Solver> solver_;  // none where the tree is faulty
};

enum class Precision { kFloat, kDouble };

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

/// Solves as above, with a solution of its own for each problem, errors included.
std::vector<IkSolution> SolveGaussNewtonBatch(const KinematicTree& tree, std::span<const IkProblem> problems,
                                              const IkOptions& options, Precision precision,
                                              const GaussNewtonOptions& own = {});

/// Returns `options` for the sweeps of `gauss-newton`, which begin and stay within ranges that have been found before.
IkOptions GaussNewtonSweepOptions(const IkOptions& options);

/// Returns the kinds of vectors that this CPU has, the widest first. For tests and benchmarks.
std::vector<std::string> BatchTargets();
/// Makes batches, and solvers that are made from now on, use this one of `BatchTargets`; the empty name: the widest.
/// For tests and benchmarks: results are the same.
void SetBatchTarget(std::string_view name);

}  // namespace etude
