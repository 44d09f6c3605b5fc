#pragma once

#include <span>

#include "engine/kinematics/ik_batch.h"
#include "engine/kinematics/solvers/batch_sweep.h"
#include "engine/kinematics/solvers/gauss_newton_course.h"
#include "engine/kinematics/solvers/gauss_newton_tree.h"
#include "engine/kinematics/solvers/lane_goals.h"

namespace etude {

/// Where lanes get their problems from, and who does for them what is rare.
class GaussNewtonQueue {
 public:
  virtual ~GaussNewtonQueue() = default;

  /// The number of the next problem to take; −1 when there is none. `Problem` is it, with the ranges that it may use,
  /// until the next call.
  virtual int Next() = 0;
  virtual IkBatch::Column Problem() const = 0;
  virtual GaussNewtonCourse Course() const = 0;

  virtual bool IsOutOfReach(int problem) = 0;
  /// Whether these angles, which nearly do, meet the goals.
  virtual bool MeetsGoals(int problem, std::span<const double> angles) = 0;
  /// Scatters and sweeps as `next` says, and counts the sweeps: `angles` are those before and after.
  virtual void Sweep(int problem, const GaussNewtonCourse::Next& next, GaussNewtonCourse& course,
                     std::span<double> angles) = 0;
  /// The problem is done, with these angles.
  virtual void Finish(int problem, const GaussNewtonCourse& course, std::span<const double> angles) = 0;
};

/// Solves problems until the queue is empty, each in a lane of its own.
void SolveInLanes(const GaussNewtonTree& tree, const LaneGoals& goals, int extra_passes, Precision precision,
                  GaussNewtonQueue& queue);

}  // namespace etude
