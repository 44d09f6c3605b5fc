#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/hinge_gain.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// How a joint of two or three degrees of freedom is turned.
enum class CcdJoint {
  kWhole,   ///< paper B, case 2: turn about each axis of the joint's rest frame in turn; after each turn take the
            ///< joint's whole rotation apart into Rx Ry Rz, clip the angles, put it together again
  kHinges,  ///< ours: as hinges about its Euler axes, each clipped at once, which never makes the gain smaller
};

/// Cyclic coordinate descent on a tree (paper B, section 3.6), sweep by sweep. Takes its memory when made; `Sweep`
/// allocates nothing. `tree` and `problem` must be free of faults (`FindFault`) and outlive this.
class CcdSweep {
 public:
  CcdSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, CcdJoint joint_kind);

  /// Turns every joint once, leaves to root: a joint after all its children (figure 3.10). Returns the largest change
  /// of an angle, radians.
  double Sweep();

  /// The two halves of `Sweep`: new angles, and what they lead to.
  double Turn();
  void Measure();

  /// What turns lower: Σ w_p e² + Σ w_o |u_c − u_d|² of the pose measured last, by the weights of the last turn (by
  /// those it ended with when they change on the way; `kWangChen` without ρ).
  double Merit() const;
  /// Puts every angle there, or to the nearest end of its range. Measures nothing.
  void SetAngles(std::span<const double> angles);

  std::span<const double> angles() const { return state_.angles; }
  /// The errors of the present angles, as forward kinematics gives them.
  std::span<const EffectorError> errors() const { return errors_; }

 private:
  void UpdateWeightsBelow(int joint);
  HingeGain GainAbout(const glm::dvec3& axis_W, int joint) const;
  void TurnBelow(int joint, const glm::dmat3& rotation);
  double TurnHinge(int joint, int axis);
  double TurnAsHinges(int joint);
  double TurnWhole(int joint);

  const KinematicTree& tree_;
  const IkProblem& problem_;
  const IkOptions options_;
  const CcdJoint joint_kind_;
  const std::vector<AngleRange> ranges_;
  std::vector<std::vector<int>> effectors_below_;  // of each joint
  TreeState state_;
  TreeFrames frames_;  // effectors are kept current while the joints below have turned, nothing else is
  std::vector<EffectorError> errors_;
  std::vector<EffectorWeights> weights_;
};

}  // namespace etude
