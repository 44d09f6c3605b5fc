#pragma once

#include <memory>
#include <span>

#include "engine/kinematics/solvers/gauss_newton_course.h"
#include "engine/kinematics/solvers/lane_goals.h"
#include "engine/kinematics/solvers/limb_packs.h"

namespace etude {

/// Who does for a problem what is rare. Angles are told at their places (`LimbPacks::places`).
class GaussNewtonHelp {
 public:
  virtual ~GaussNewtonHelp() = default;

  virtual bool IsOutOfReach() = 0;
  /// Whether these angles, which nearly do, meet the goals.
  virtual bool MeetsGoals(std::span<const double> angles) = 0;
  /// Scatters and sweeps as `next` says, and counts the sweeps: `angles` are those before and after.
  virtual void Sweep(const GaussNewtonCourse::Next& next, GaussNewtonCourse& course, std::span<double> angles) = 0;
};

/// `gauss-newton` for one problem after the other of one tree, four limbs in the lanes of the CPU's vectors, then the
/// trunk by rows. Takes its memory when made.
class GaussNewtonLimbs {
 public:
  /// For the widest vectors that may be used now (`SetBatchTarget`). `packs` must outlive it.
  static std::unique_ptr<GaussNewtonLimbs> Make(const LimbPacks& packs);
  virtual ~GaussNewtonLimbs() = default;

  /// A problem, and in the end its answer. Angles at their places; other places stay as they are made.
  double *angles = nullptr, *lower = nullptr, *upper = nullptr;
  double root[12] = {};  ///< p_WL, and R_WL column by column

  /// The target of an effector: numbers as `IkBatch::target` has them, four places apart; the position's weight per
  /// square of `kPositionScale`.
  virtual double* TargetOf(int effector) = 0;

  /// X_WE at the last pose that was placed: the answer's, if `course` has converged.
  struct End {
    double position[3], axes[3][3];
  };
  virtual End EndOf(int effector) = 0;

  /// Goes `course` to its end.
  virtual void Solve(const LaneGoals& goals, int extra_passes, GaussNewtonCourse& course, GaussNewtonHelp& help) = 0;
};

}  // namespace etude
