#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/sweep_kernel.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The sweeps of `CcdSweep` with `CcdJoint::kHinges` and weights refreshed every sweep, in moment form
/// (sweep_kernel.h): the same angles to rounding, several times faster. Not for `WeightRule::kWangChen`, whose weights
/// differ from joint to joint. Takes its memory when made; `Sweep` allocates nothing. `tree` and `problem` must be free
/// of faults (`FindFault`) and outlive this.
class MomentSweep {
 public:
  MomentSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

  /// Whether moments can carry the weights that these options ask for.
  static bool CanServe(const IkOptions& options);

  /// Turns every joint once, leaves to root. Returns the largest change of an angle (its chord), radians.
  double Sweep();

  /// The present angles, radians.
  std::vector<double> Angles() const;
  /// The errors of the present angles, as forward kinematics gives them.
  std::span<const EffectorError> errors() const { return errors_; }

 private:
  void UpdateLimbs();

  const IkProblem& problem_;
  const WeightRule rule_;
  const std::vector<AngleRange> ranges_;
  const SweepTree tree_;
  std::vector<Hinge<double>> hinges_;
  std::vector<LimbOf<double>> limbs_;
  std::vector<GoalOf<double>> goals_;
  std::vector<Moments<double>> moments_;
  std::vector<EffectorError> errors_;
};

}  // namespace etude
