#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The limbs of one person, metres, both sides alike. The default is an adult.
struct LimbLengths {
  double foot = 0.18;   ///< ankle to toe tips
  double shank = 0.42;  ///< knee to ankle
  double thigh = 0.43;  ///< hip to knee
  double hip_width = 0.18;
  double trunk = 0.50;           ///< navel (midway between the hips) to the base of the neck
  double neck = 0.25;            ///< base of the neck to the head
  double shoulder_width = 0.36;  ///< the base of the neck is its middle
  double upper_arm = 0.29;
  double forearm = 0.25;
  double hand = 0.18;  ///< wrist to finger tips
};

/// Every length is finite and more than zero.
bool IsValid(const LimbLengths& lengths);

/// The range of one joint angle, radians.
struct AngleRange {
  double lower = 0;
  double upper = 0;
};

/// `angle` itself, or a full turn away, when that lies in `range`; else the end of `range` nearest to it on the circle:
/// an angle just short of −π is next to +170°, not to −50°.
double ClampAngle(double angle, const AngleRange& range);

/// A point that turns, and the rigid limb beyond it. The limb's frame has its Z axis along the limb (paper B, section
/// 3.3): F = F_parent · rest · Rx(q₀) Ry(q₁) Rz(q₂), a joint of fewer degrees of freedom leaving out the last ones.
struct TreeJoint {
  std::string_view name;
  Role role;             ///< where it sits on the canonical body
  int parent = -1;       ///< parents stand before children; −1 for the root, which does not turn
  glm::dvec3 offset{0};  ///< from the parent's joint, in the frame of the parent's limb, metres
  glm::dmat3 rest{1};    ///< the limb's frame in the parent's, when all angles are zero
  int first_dof = 0;     ///< index of its X angle among all angles
  int dof_count = 0;     ///< 0…3
};

/// The free end of a limb, which a target is set for.
struct Effector {
  std::string_view name;
  Role role;
  int joint = 0;         ///< whose limb it ends
  glm::dvec3 offset{0};  ///< in that limb's frame, metres
};

/// A kinematic tree as data: nothing that works on it knows which body it is.
struct KinematicTree {
  std::vector<TreeJoint> joints;
  std::vector<Effector> effectors;
  std::vector<AngleRange> limits;  ///< of each degree of freedom
  glm::dmat3 standing_root{1};     ///< the root's frame of a body that stands upright and faces +Z

  int dof_count() const { return static_cast<int>(limits.size()); }
};

/// Which of B6's limbs is which: indices of `MakeBodyTree(…).joints`.
enum BodyTreeJoint {
  kTreeLeftToe,
  kTreeLeftAnkle,
  kTreeLeftKnee,
  kTreeLeftHip,
  kTreeNavel,
  kTreeLeftShoulder,
  kTreeLeftElbow,
  kTreeLeftWrist,
  kTreeRightShoulder,
  kTreeRightElbow,
  kTreeRightWrist,
  kTreeNeck,
  kTreeRightHip,
  kTreeRightKnee,
  kTreeRightAnkle,
  kBodyTreeJointCount
};

/// Paper B's body (figure 3.10): rooted at the left toe, 15 joints, 29 degrees of freedom,
/// limits `adult`, effectors right foot, left hand, right hand, head in this order. At rest (all angles zero) it
/// stands with hanging arms. *Ours*: its feet are level then; on real clips that keeps the ankles within their limits
/// most often.
KinematicTree MakeBodyTree(const LimbLengths& lengths);

/// Everything that a pose of the tree consists of.
struct TreeState {
  glm::dvec3 root_position{0};
  glm::dmat3 root_frame{1};    ///< of the root's limb, in the world
  std::vector<double> angles;  ///< radians, one per degree of freedom
};

/// All angles zero, the root at the origin.
TreeState StandingState(const KinematicTree& tree);

/// A place and the three axes of a limb, in the world.
struct LimbFrame {
  glm::dvec3 position{0};
  glm::dmat3 axes{1};
};

/// Forward kinematics of one pose, all in the world.
struct TreeFrames {
  std::vector<LimbFrame> joints;  ///< of each joint, and the frame of its limb
  std::vector<glm::dmat3> bases;  ///< of each joint: its limb's frame before the joint turns (F_parent · rest)
  /// Of each degree of freedom: the world's axis about which it turns what hangs below.
  std::vector<glm::dvec3> dof_axes;
  std::vector<LimbFrame> effectors;
};

/// Fills `out`, which keeps its memory from call to call.
void ComputeFrames(const KinematicTree& tree, const TreeState& state, TreeFrames& out);
TreeFrames ComputeFrames(const KinematicTree& tree, const TreeState& state);

/// The angles of `joint` as x, y, z; those it does not have are zero.
glm::dvec3 JointAngles(const TreeJoint& joint, std::span<const double> angles);

/// The world's axis about which `axis` (0 = X, 1 = Y, 2 = Z) of `joint` turns what hangs below.
glm::dvec3 DofAxis(const TreeJoint& joint, const glm::dmat3& base, std::span<const double> angles, int axis);

}  // namespace etude
