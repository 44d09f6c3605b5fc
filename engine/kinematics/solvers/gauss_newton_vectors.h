#pragma once

// The border between what is compiled once and what is compiled once per instruction set: plain numbers, no GLM.
#include <cstddef>
#include <memory>
#include <span>

#include "engine/kinematics/solvers/gauss_newton_course.h"
#include "engine/kinematics/solvers/gauss_newton_tree.h"

namespace etude {

enum class Precision;

/// The part of the options that vector code needs.
struct GaussNewtonRules {
  /// A pose meets its goals when its largest squared distance and chord are below the first of these, and misses them
  /// when one is not below the second. In between it must be measured once more.
  double squared_distance_met = 0, squared_distance_missed = 0;
  double squared_chord_met = 0, squared_chord_missed = 0;
  int extra_passes = 0;
  double largest_turn = 0;  ///< `kLargestTurn`

  /// Returns whether a pose meets the goals, by `measure()` where that is in doubt.
  template <class Measure>
  bool AreMet(double squared_distance, double squared_chord, const Measure& measure) const {
    // So that what is no number meets nothing.
    if (!(squared_distance < squared_distance_missed && squared_chord < squared_chord_missed)) return false;
    return (squared_distance < squared_distance_met && squared_chord < squared_chord_met) || measure();
  }
};

GaussNewtonRules RulesFor(const IkOptions& options, const GaussNewtonOptions& own, Precision precision);

/// Does the rare steps, one number at a time. Problems are told apart by number; angles are in the tree's order.
class GaussNewtonHelp {
 public:
  virtual ~GaussNewtonHelp() = default;

  /// Returns whether no pose can meet the problem's targets.
  virtual bool IsOutOfReach(int problem) = 0;
  /// Returns whether these angles, which nearly do, meet the goals.
  virtual bool MeetsGoals(int problem, std::span<const double> angles) = 0;
  /// Scatters and sweeps as `next` says, and counts the sweeps: `angles` are those before and after.
  virtual void Sweep(int problem, const GaussNewtonCourse::Next& next, GaussNewtonCourse& course,
                     std::span<double> angles) = 0;
};

// ---- One problem, four limbs in lanes (gauss_newton_limbs.cc) ------------------------------------------------------

/// Solves one problem after the other of one tree, four limbs in the lanes of the CPU's vectors, then the trunk by
/// rows. Takes its memory when made.
class GaussNewtonLimbs {
 public:
  /// Makes one for the widest vectors that may be used now (`SetBatchTarget`). `packs` must outlive it.
  static std::unique_ptr<GaussNewtonLimbs> Make(const LimbPacks& packs);
  virtual ~GaussNewtonLimbs() = default;

  /// A problem, and in the end its answer. Angles are at their places (`LimbPacks::places`); all other places stay as
  /// they are made.
  double *angles = nullptr, *lower = nullptr, *upper = nullptr;
  double root[12] = {};  ///< p_WL, and R_WL column by column

  /// Returns the target of an effector: numbers as `IkBatch::target` has them, four places apart; the position's weight
  /// per square of `kPositionScale`.
  virtual double* TargetOf(int effector) = 0;

  /// X_WE at the last pose that was placed: the answer's, if the course has converged.
  struct End {
    double position[3], axes[3][3];
  };
  virtual End EndOf(int effector) = 0;

  /// Follows `course` to its end. To `help` the problem is number 0.
  virtual void Solve(const GaussNewtonRules& rules, GaussNewtonCourse& course, GaussNewtonHelp& help) = 0;
};

// ---- Many problems, each in a lane (gauss_newton_lanes.cc) ---------------------------------------------------------

/// Hands out problems and takes back answers.
class GaussNewtonQueue {
 public:
  virtual ~GaussNewtonQueue() = default;

  /// The numbers of a problem, `stride` apart, as `IkBatch::column` has them, with the ranges that it may use.
  struct Column {
    const double* numbers = nullptr;
    std::size_t stride = 1;
  };

  /// Takes the next problem. Returns its number, or −1 when there is none.
  virtual int Next() = 0;
  /// Returns the problem that was taken last.
  virtual Column Problem() const = 0;
  /// Returns the course of a problem that begins.
  virtual GaussNewtonCourse Course() const = 0;
  /// Takes the answer to a problem.
  virtual void Finish(int problem, const GaussNewtonCourse& course, std::span<const double> angles) = 0;
};

/// Solve problems until the queue is empty, each in a lane of its own.
void SolveInFloats(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                   GaussNewtonHelp& help);
void SolveInDoubles(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                    GaussNewtonHelp& help);

}  // namespace etude
