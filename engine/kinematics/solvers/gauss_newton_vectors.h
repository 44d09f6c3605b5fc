#pragma once

// The interface between code that is compiled once and code that is compiled once per instruction set: plain numbers,
// no GLM.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/kinematics/solvers/gauss_newton_course.h"
#include "engine/kinematics/solvers/gauss_newton_tree.h"

namespace etude {

enum class Precision;

/// The options that vector code needs.
struct GaussNewtonRules {
  /// A pose meets the goals if its largest squared distance and its largest squared chord are below `…_met`, and misses
  /// the goals if one of these numbers is not below its `…_missed`. In other cases the pose's errors must be measured
  /// exactly.
  double squared_distance_met = 0, squared_distance_missed = 0;
  double squared_chord_met = 0, squared_chord_missed = 0;
  int extra_passes = 0;
  double max_turn = 0;  ///< `kMaxTurn`
  bool traces = false;  ///< true: the angles after every step go to `GaussNewtonHelp::Record` (one problem only)

  /// Returns true if a pose meets the goals. If the squares are too close to the goals to decide, returns `measure()`.
  template <class Measure>
  bool AreMet(double squared_distance, double squared_chord, const Measure& measure) const {
    // NaN fails every comparison, so a NaN residual never meets the goals.
    if (!(squared_distance < squared_distance_missed && squared_chord < squared_chord_missed)) return false;
    return (squared_distance < squared_distance_met && squared_chord < squared_chord_met) || measure();
  }
};

/// Returns the rules for these options and this precision.
GaussNewtonRules RulesFor(const IkOptions& options, const GaussNewtonOptions& own, Precision precision);

/// Scalar code for the rare operations of the vector solvers. `problem` is a problem's number; angles are in the tree's
/// order.
class GaussNewtonHelp {
 public:
  virtual ~GaussNewtonHelp() = default;

  /// Returns true if no pose can meet the problem's targets.
  virtual bool IsOutOfReach(int problem) = 0;
  /// Measures the errors at these angles. Returns true if they meet the goals.
  virtual bool MeetsGoals(int problem, std::span<const double> angles) = 0;
  /// Replaces `angles` by the pose of restart `next.restart` (0: keeps them), then sweeps up to `next.sweeps` times
  /// from there. Counts the sweeps in `course`.
  virtual void Sweep(int problem, const GaussNewtonCourse::Next& next, GaussNewtonCourse& course,
                     std::span<double> angles) = 0;
  /// Records the angles after a step.
  virtual void Record(std::span<const double> angles) = 0;
};

/// Returns the names of the instruction sets that this CPU supports, widest vectors first. For tests and benchmarks.
std::vector<std::string> BatchTargets();
/// Selects one of `BatchTargets` for batches, for solvers made from now on, and for all other code that Highway
/// compiles once per instruction set; an empty name selects the widest. For tests and benchmarks: all targets give the
/// same results.
void SetBatchTarget(std::string_view name);

// ---- One problem, four limbs in lanes (gauss_newton_limbs.cc) ------------------------------------------------------

/// Solves problems of one tree one after the other, with four limbs side by side in the lanes of the CPU's vectors, and
/// the joints of the trunk one by one. The constructor allocates all memory.
class GaussNewtonLimbs {
 public:
  /// Makes a solver for the vectors that `SetBatchTarget` selects. `packs` must outlive it.
  static std::unique_ptr<GaussNewtonLimbs> Make(const LimbPacks& packs);
  virtual ~GaussNewtonLimbs() = default;

  /// Input: start angles and ranges; output: the solved angles. Their indices are those in `LimbPacks::places`; all
  /// other entries must stay unchanged.
  double *angles = nullptr, *lower = nullptr, *upper = nullptr;
  double root[12] = {};  ///< p_WL, then R_WL column by column

  /// Returns the memory of an effector's target: the numbers of `IkBatch::target`, stored four doubles apart, but with
  /// the position weight divided by `kPositionScale`².
  virtual double* TargetOf(int effector) = 0;

  /// The pose X_WE of an effector at the pose placed last, which is the solution if the course has converged.
  struct End {
    double position[3], axes[3][3];
  };
  virtual End EndOf(int effector) = 0;

  /// Solves the problem; `course` decides the actions. It calls `help` with the problem number 0.
  virtual void Solve(const GaussNewtonRules& rules, GaussNewtonCourse& course, GaussNewtonHelp& help) = 0;
};

// ---- Many problems, each in a lane (gauss_newton_lanes.cc) ---------------------------------------------------------

/// The queue from which the lanes get problems, and which receives their solutions.
class GaussNewtonQueue {
 public:
  virtual ~GaussNewtonQueue() = default;

  /// A problem in the layout of `IkBatch::column`. Its limits are replaced by its allowed ranges.
  struct Column {
    const double* numbers = nullptr;
    std::size_t stride = 1;
  };

  /// Advances to the next problem. Returns its number, or −1 if there is none.
  virtual int Next() = 0;
  /// Returns the problem that `Next` advanced to.
  virtual Column Problem() const = 0;
  /// Returns a new course (gauss_newton_course.h), which chooses a problem's actions.
  virtual GaussNewtonCourse Course() const = 0;
  /// Receives the solution of a problem.
  virtual void Finish(int problem, const GaussNewtonCourse& course, std::span<const double> angles) = 0;
};

/// SolveInFloats and SolveInDoubles solve all problems of the queue, each in one lane, in the named precision.
void SolveInFloats(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                   GaussNewtonHelp& help);
void SolveInDoubles(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                    GaussNewtonHelp& help);

}  // namespace etude
