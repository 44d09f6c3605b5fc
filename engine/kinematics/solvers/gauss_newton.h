#pragma once

#include <memory>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

struct GaussNewtonOptions {
  /// Sweeps of coordinate descent before the first Gauss–Newton step. None: damped steps do better from the start than
  /// from a pose whose angles sweeps have driven into their limits. Of 200 starts off by 15° all are solved with 0 to
  /// 20 of them, in 5.3, 6.9 and 24.6 iterations with 0, 2 and 20. Raise it to compare.
  int first_sweeps = 0;
  /// Extra passes of a step's active set when damping is small: the null-space components of the step depend on which
  /// limits are active. Over the joints' whole ranges three take 4.27 instead of 4.49 iterations from starts off by
  /// 15°, and of 500 starts off by 2° leave 5 farther than 0.01 rad from the nearest solution instead of 16; one does
  /// most of that, six no more. Set it to 0 where a step's time counts more than its answer.
  int extra_passes = 3;
};

/// *Ours*, the default solver. Of all poses that meet the targets within the limits it looks for the one nearest to the
/// start: hidden angles, which no target sees, stay where they were. In turn, until the targets are met:
///
/// 1. `first_sweeps` sweeps of coordinate descent, none by default;
/// 2. Gauss–Newton steps pulled towards the start (gauss_newton_step.h), with damping in proportion to the squared
///    residual: far away steps are short, so that few angles run into their limits, and near the targets convergence
///    is quadratic;
/// 3. the same without the pull, where it has led to limits that block: Levenberg–Marquardt steps, which never raise
///    the residual;
/// 4. restarts from other poses around the start, two sweeps and such steps each, twenty unless the targets are out of
///    any pose's reach;
/// 5. from the pose of the least residual, such steps until they stall: the answer where targets cannot be met.
///
/// Nearly always the second is the last. With few iterations 2 and 3 give up sooner, so that a solver which is blocked
/// by limits gets past them within some frames of a motion. One iteration is one sweep or one step; a trace can jump
/// where 4 and 5 begin, and without convergence the solution is the pose of the least residual, not the last one of
/// the trace. The sweeps' weights are `adaptive-power`.
IkSolution SolveGaussNewton(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const GaussNewtonOptions& own = {});

/// The same for many problems of one tree, one after the other: what is the tree's own, its validity and the order of
/// its joints, is looked at once, and memory is taken once. `tree` must outlive this. Along a motion, or where problems
/// come one by one; many at once are faster together (gauss_newton_batch.h).
class GaussNewtonSolver {
 public:
  explicit GaussNewtonSolver(const KinematicTree& tree);
  ~GaussNewtonSolver();

  /// Of the object only its memory changes: an answer does not depend on what was asked before.
  IkSolution Solve(const IkProblem& problem, const IkOptions& options, const GaussNewtonOptions& own = {}) const;

 private:
  class Solver;

  const KinematicTree& tree_;
  std::unique_ptr<Solver> solver_;  // none where the tree is faulty
};

/// `options` for the sweeps of `gauss-newton`, which begin and stay within ranges that have been found before.
IkOptions GaussNewtonSweepOptions(const IkOptions& options);

}  // namespace etude
