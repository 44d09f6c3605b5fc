#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The sweeps of `CcdSweep` with `CcdJoint::kHinges` and weights refreshed every sweep, in moment form
/// (moment_sweep.cc): the same angles to rounding, four times faster. Not for `WeightRule::kWangChen`, whose weights
/// differ from joint to joint. Takes its memory when made; `Sweep` allocates nothing. `tree` and `problem` must be free
/// of faults (`FindFault`) and outlive this.
class MomentSweep {
 public:
  MomentSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);
  ~MomentSweep();

  /// Returns whether moments can carry the weights that these options ask for.
  static bool CanServe(const IkOptions& options);

  /// Turns every joint once, leaves to root. Returns the largest change of an angle (its chord), radians.
  double Sweep();

  /// The two halves of `Sweep`: `Turn` finds new angles, `Measure` the errors that they lead to.
  double Turn();
  void Measure();

  /// Returns what turns lower: Σ w_p e² + Σ w_o |u_c − u_d|² of the pose measured last, by the weights of the last
  /// turn.
  double Merit() const;
  /// Writes tan((q − middle) / 2) of every present angle; the middle is that of its range, or a free angle's start.
  void ReadHalfTangents(std::span<double> out) const;
  /// Sets every angle, or the nearest end of its range. Measures nothing.
  void SetHalfTangents(std::span<const double> half_tangents);

  /// Returns whether the pose measured last certainly misses the goals of the options: much cheaper than `errors`. When
  /// not, errors decide.
  bool MissesGoals() const;

  /// Returns the present angles, radians.
  std::vector<double> Angles() const;
  /// Returns the errors of the pose measured last; axis angles are off by up to 10⁻¹² of themselves.
  std::vector<EffectorError> errors() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace etude
