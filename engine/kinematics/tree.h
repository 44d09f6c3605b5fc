#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace etude {

/// The range of one joint angle, radians.
struct AngleRange {
  double lower = 0;
  double upper = 0;
};

/// Returns `angle`, or a full turn away, if that lies in `range`; else the end of `range` nearest to it on the circle:
/// an angle just short of −π is next to +170°, not to −50°.
double ClampAngle(double angle, const AngleRange& range);

/// A point that turns, and the rigid limb beyond it. The frame of the limb L stands at the joint, its Z axis along the
/// limb (paper B, section 3.3). With P the parent's limb and J the limb's frame before the joint turns,
///     R_WL = R_WP R_PJ R_JL,   R_JL = Rx(q₀) Ry(q₁) Rz(q₂),   p_WL = p_WP + R_WP p_PJ;
/// a joint of fewer degrees of freedom leaves out the last ones. W is the world.
struct TreeJoint {
  std::string_view name;
  int parent = -1;     ///< parents stand before children; −1 for the root, which does not turn
  glm::dvec3 p_PJ{0};  ///< metres
  glm::dmat3 R_PJ{1};
  int first_dof = 0;  ///< index of its X angle among all angles
  int dof_count = 0;  ///< 0…3
};

/// The free end E of a limb L, which a target is set for. Its axes are the limb's.
struct Effector {
  std::string_view name;
  int joint = 0;       ///< whose limb it ends
  glm::dvec3 p_LE{0};  ///< metres
};

/// A point Q of a limb L of a tree.
struct TreePoint {
  int joint = 0;       ///< whose limb it is fixed to
  glm::dvec3 p_LQ{0};  ///< metres
};

/// A kinematic tree as data, whatever body it is of. Paper B's is in body_tree.h.
struct KinematicTree {
  std::vector<TreeJoint> joints;
  std::vector<Effector> effectors;
  std::vector<AngleRange> limits;  ///< of each degree of freedom
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

/// The pose X_WF of a frame F in the world: a limb's, an effector's.
struct LimbFrame {
  glm::dvec3 position{0};  ///< p_WF
  glm::dmat3 axes{1};      ///< R_WF
};

/// Forward kinematics of one pose, all in the world.
struct TreeFrames {
  std::vector<LimbFrame> joints;     ///< X_WL of each joint's limb
  std::vector<glm::dmat3> R_WJ;      ///< of each joint: its limb's axes before the joint turns
  std::vector<glm::dvec3> dof_axes;  ///< of each degree of freedom: the unit vector about which it turns what is below
  std::vector<LimbFrame> effectors;  ///< X_WE
};

/// Computes the frames of a pose. `out` keeps its memory from call to call.
void ComputeFrames(const KinematicTree& tree, const TreeState& state, TreeFrames& out);
TreeFrames ComputeFrames(const KinematicTree& tree, const TreeState& state);

/// Returns the angles of `joint` as x, y, z; those it does not have are zero.
glm::dvec3 JointAngles(const TreeJoint& joint, std::span<const double> angles);

/// Returns the unit vector of the world about which `axis` (0 = X, 1 = Y, 2 = Z) of `joint` turns what is below.
glm::dvec3 DofAxis(const TreeJoint& joint, const glm::dmat3& R_WJ, std::span<const double> angles, int axis);

}  // namespace etude
