#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Computes the sweeps of `CcdSweep` with `CcdJoint::kHinges` and `WeightRefresh::kSweep` from the targets' moments
/// (moment_sweep.cc). The angles are equal up to rounding, and a sweep is four times as fast. The moment form does
/// not support `WeightRule::kWangChen`, whose weights differ from joint to joint. The constructor allocates all
/// memory; `Sweep` allocates nothing. `tree` and `problem` must be free of faults (`FindFault`) and outlive this
/// object.
class MomentSweep {
 public:
  MomentSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);
  ~MomentSweep();

  /// Returns true if the moment form supports the weights of these options.
  static bool CanServe(const IkOptions& options);

  /// Turns every joint once, from the leaves to the root. Returns the largest turn of a hinge as its chord,
  /// 2 sin(turn / 2), which equals the turn in radians for small turns.
  double Sweep();

  /// The two halves of `Sweep`: `Turn` computes new angles, `Measure` computes the limbs' frames and the distances to
  /// the goals.
  double Turn();
  void Measure();

  /// Returns the sum that a sweep reduces, Σ w_p e² + Σ w_o |u_c − u_d|², at the pose measured last, with the weights
  /// of the last turn.
  double Merit() const;
  /// Writes tan((q − middle) / 2) of every angle, where `middle` is the middle of its range, or the start of a free
  /// angle.
  void ReadHalfTangents(std::span<double> out) const;
  /// Sets every angle, clamped to its range. Does not update the errors.
  void SetHalfTangents(std::span<const double> half_tangents);

  /// Returns true if the pose measured last certainly misses the goals; this test is much cheaper than `errors`. If it
  /// returns false, compare `errors` with the goals.
  bool MissesGoals() const;

  /// Returns the angles, radians.
  std::vector<double> Angles() const;
  /// Returns the errors of the pose measured last; axis angles have a relative error of up to 10⁻¹².
  std::vector<EffectorError> errors() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace etude
