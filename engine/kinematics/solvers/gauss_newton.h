#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/kinematics/ik_batch.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace [[gnu::visibility("default")]] etude {

struct GaussNewtonOptions {
  /// The number of sweeps of coordinate descent before the first Gauss–Newton step. The default is 0, because sweeps
  /// move angles to their limits, and damped steps work worse from there than from the start pose. Raise it only to
  /// compare (README.md has the figures).
  int first_sweeps = 0;
  /// The number of extra active-set passes per step while damping is small. Extra passes find which limits are active;
  /// the null-space components of the step depend on these limits. More than three passes change the step little. Set
  /// it to 0 if the time per step matters more than its accuracy.
  int extra_passes = 3;
  /// The number of restarts from other poses when steps are stuck. Set it to 0 if targets are often unreachable and the
  /// start is near: all iterations then minimise the residual around the start.
  int restarts = 20;
};

/// The default solver (*ours*). Of all poses that meet the targets within the limits, it finds one near the start, so
/// hidden angles, which no target determines, stay near their start values. It runs these phases until the targets are
/// met:
///
/// 1. `first_sweeps` sweeps of coordinate descent, none by default;
/// 2. Gauss–Newton steps with a pull towards the start. The damping is proportional to the squared
///    residual: far from the targets steps are short, so few angles reach their limits, and near the targets
///    convergence is quadratic;
/// 3. Levenberg–Marquardt steps without the pull, if the pull has led to limits that block progress. These steps never
///    raise the residual;
/// 4. `restarts` from other poses around the start, each with two sweeps and steps as in 3; none if the targets are out
///    of reach of any pose;
/// 5. from the pose of the smallest residual, steps as in 3 until they stall. The pose where they stall is the answer
///    if the targets cannot be met.
///
/// Most problems end in phase 2. If few iterations are allowed, phases 2 and 3 end sooner, so that along a motion a
/// blocked solver recovers within a few frames. One iteration is one sweep or one step. A trace can jump where phases 4
/// and 5 begin, and without convergence the solution is the pose of the smallest residual, not the last pose of the
/// trace. Sweeps use the weights `adaptive-power`.
IkSolution SolveGaussNewton(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const GaussNewtonOptions& own = {});

/// Solves problems of one tree, one after the other, like `SolveGaussNewton`. The tree is checked and its joints are
/// ordered once, and memory is allocated once. `tree` must outlive this object. Use it along a motion, or for problems
/// that arrive one by one; for many problems at once, `SolveGaussNewtonBatch` is faster.
class GaussNewtonSolver {
 public:
  explicit GaussNewtonSolver(const KinematicTree& tree);
  ~GaussNewtonSolver();

  /// Solves one problem. The answer does not depend on earlier problems.
  IkSolution Solve(const IkProblem& problem, const IkOptions& options, const GaussNewtonOptions& own = {}) const;

 private:
  class Solver;

  const KinematicTree& tree_;
  std::unique_ptr<Solver> solver_;  // null if the tree has a fault
};

/// The floating-point type of a batch.
enum class Precision { kFloat, kDouble };

/// Solves many problems of one tree at once by `gauss-newton`. Each problem keeps one lane of the SIMD vectors from its
/// start to its last restart; then the lane takes the next problem. Results do not depend on the vectors' width or on
/// the other problems. Scalar code compares errors with goals where rounding could decide, and computes the poses of
/// restarts with their sweeps; everything else runs in lanes.
/// - `kDouble`: every solution equals that of `SolveGaussNewton` to the last bit.
/// - `kFloat`: twice as many lanes. The solver aims at nine tenths of each goal, so that the requested goal is met in
///   double. Damping is at least 10⁻⁵ before phase 5. Once the squared residual is below 10⁻⁶, steps are taken
///   without the pull to the start, which float cannot resolve there. A problem that float does not solve is solved
///   again in double from its start; only the iterations in double are reported. If several poses meet the targets,
///   float may find another pose than double. Do not use `kFloat` for goals below 2·10⁻⁴ cm or degrees.
/// A faulty problem gets kBadInput; if the tree or the options have a fault, all problems do. `IkOptions::trace` is
/// ignored.
IkBatchSolution SolveGaussNewtonBatch(const KinematicTree& tree, const IkBatch& problems, const IkOptions& options,
                                      Precision precision, const GaussNewtonOptions& own = {});

/// Solves like the function above, and returns one solution per problem, with errors.
std::vector<IkSolution> SolveGaussNewtonBatch(const KinematicTree& tree, std::span<const IkProblem> problems,
                                              const IkOptions& options, Precision precision,
                                              const GaussNewtonOptions& own = {});

}  // namespace etude
