#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] etude {

/// The range of one joint angle, radians.
struct AngleRange {
  double lower = 0;
  double upper = 0;
};

/// Returns `angle`, or `angle` ± 2π if that lies in `range` instead. If none of these does, returns the end of `range`
/// that is nearest on the circle. For example, for the range −50° to 170°, an angle just above −180° gives 170°, not
/// −50°.
double ClampAngle(double angle, const AngleRange& range);

/// A joint and the rigid limb beyond it. The frame of the limb L is at the joint, with its Z axis along the limb (paper
/// B, section 3.3). With P the parent's limb and J the limb's frame before the joint turns,
///     R_WL = R_WP R_PJ R_JL,   R_JL = Rx(q₀) Ry(q₁) Rz(q₂),   p_WL = p_WP + R_WP p_PJ.
/// A joint with fewer degrees of freedom omits the last rotations. W is the world.
struct TreeJoint {
  std::string_view name;
  int parent = -1;     ///< parents come before children; −1 for the root, which does not turn
  glm::dvec3 p_PJ{0};  ///< metres
  glm::dmat3 R_PJ{1};
  int first_dof = 0;  ///< index of the joint's X angle in the list of all angles
  int dof_count = 0;  ///< 0…3
};

/// The end effector E of a limb L. The axes of E are the limb's axes.
struct Effector {
  std::string_view name;
  int joint = 0;       ///< the joint whose limb ends here
  glm::dvec3 p_LE{0};  ///< metres
};

/// A point Q that is fixed to a limb L of a tree.
struct TreePoint {
  int joint = 0;       ///< the joint of that limb
  glm::dvec3 p_LQ{0};  ///< metres
};

/// A kinematic tree as data. Nothing here is specific to a body; paper B's body is in body_tree.h.
struct KinematicTree {
  std::vector<TreeJoint> joints;
  std::vector<Effector> effectors;
  std::vector<AngleRange> limits;  ///< one per degree of freedom
  glm::dmat3 standing_root{1};     ///< R_WL of the root in `StandingState`

  int dof_count() const { return static_cast<int>(limits.size()); }
};

/// A pose of the tree.
struct TreeState {
  glm::dvec3 root_position{0};  ///< p_WL of the root
  glm::dmat3 root_frame{1};     ///< R_WL of the root
  std::vector<double> angles;   ///< radians, one per degree of freedom
};

/// Returns the pose with all angles zero and the root at the origin.
TreeState StandingState(const KinematicTree& tree);

/// The pose X_WF of a limb's or an effector's frame F in the world.
struct LimbFrame {
  glm::dvec3 position{0};  ///< p_WF
  glm::dmat3 axes{1};      ///< R_WF
};

/// The result of forward kinematics for one pose; everything is expressed in the world.
struct TreeFrames {
  std::vector<LimbFrame> joints;     ///< X_WL of each joint's limb
  std::vector<glm::dmat3> R_WJ;      ///< for each joint: the limb's axes before the joint turns
  std::vector<glm::dvec3> dof_axes;  ///< for each degree of freedom: the unit vector of the rotation axis
  std::vector<LimbFrame> effectors;  ///< X_WE
};

/// Computes the frames of a pose. The memory of `out` is reused from call to call.
void ComputeFrames(const KinematicTree& tree, const TreeState& state, TreeFrames& out);
TreeFrames ComputeFrames(const KinematicTree& tree, const TreeState& state);

/// Returns the angles of `joint` as x, y, z; angles that the joint does not have are zero.
glm::dvec3 JointAngles(const TreeJoint& joint, std::span<const double> angles);

/// Returns the rotation axis `axis` (0 = X, 1 = Y, 2 = Z) of `joint` at these angles, as a unit vector in the world.
glm::dvec3 DofAxis(const TreeJoint& joint, const glm::dmat3& R_WJ, std::span<const double> angles, int axis);

}  // namespace etude
