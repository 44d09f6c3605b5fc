#include "engine/kinematics/tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/kinematics/sine_cosine.h"

namespace etude {
namespace {

/// Multiplies R_WF by the rotation by `angle` about F's axis `kAxis`. Returns that axis, which the rotation does not
/// change.
template <int kAxis>
glm::dvec3 TurnColumns(glm::dmat3& R_WF, double angle) {
  constexpr int i = (kAxis + 1) % 3, j = (kAxis + 2) % 3;
  const auto [s, c] = ComputeSineCosine(angle);
  const glm::dvec3 x = R_WF[i], y = R_WF[j];
  R_WF[i] = c * x + s * y;
  R_WF[j] = c * y - s * x;
  return R_WF[kAxis];
}

}  // namespace

double ClampAngle(double angle, const AngleRange& range) {
  if (angle >= range.lower && angle <= range.upper) return angle;
  const double middle = 0.5 * (range.lower + range.upper);
  return std::clamp(middle + std::remainder(angle - middle, 2 * kPi), range.lower, range.upper);
}

TreeState StandingState(const KinematicTree& tree) {
  return {glm::dvec3(0), tree.standing_root, std::vector<double>(tree.limits.size(), 0.0)};
}

glm::dvec3 JointAngles(const TreeJoint& joint, std::span<const double> angles) {
  glm::dvec3 xyz(0);
  for (int axis = 0; axis < joint.dof_count; ++axis) xyz[axis] = angles[joint.first_dof + axis];
  return xyz;
}

glm::dvec3 DofAxis(const TreeJoint& joint, const glm::dmat3& R_WJ, std::span<const double> angles, int axis) {
  if (axis == 0) return R_WJ[0];
  const glm::dvec3 q = JointAngles(joint, angles);
  // The rotation about X turns the Y axis; the rotations about X and Y turn the Z axis.
  const double cx = std::cos(q.x), sx = std::sin(q.x);
  if (axis == 1) return R_WJ * glm::dvec3(0, cx, sx);
  const double cy = std::cos(q.y), sy = std::sin(q.y);
  return R_WJ * glm::dvec3(sy, -sx * cy, cx * cy);
}

void ComputeFrames(const KinematicTree& tree, const TreeState& state, TreeFrames& out) {
  assert(state.angles.size() == tree.limits.size());
  out.joints.resize(tree.joints.size());
  out.R_WJ.resize(tree.joints.size());
  out.dof_axes.resize(tree.limits.size());
  out.effectors.resize(tree.effectors.size());
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    const TreeJoint& joint = tree.joints[i];
    // The root takes its frame from the state.
    if (joint.parent < 0) {
      out.joints[i] = {state.root_position, state.root_frame};
      out.R_WJ[i] = state.root_frame;
      continue;
    }
    // Compute the joint's rest axes from its parent, then the rotations that it has about X, Y and Z.
    const LimbFrame& X_WP = out.joints[joint.parent];
    glm::dmat3 R_WL = X_WP.axes * joint.R_PJ;  // R_WJ until the joint turns
    out.R_WJ[i] = R_WL;
    const double* angles = state.angles.data() + joint.first_dof;
    glm::dvec3* dof_axes = out.dof_axes.data() + joint.first_dof;
    if (joint.dof_count > 0) dof_axes[0] = TurnColumns<0>(R_WL, angles[0]);
    if (joint.dof_count > 1) dof_axes[1] = TurnColumns<1>(R_WL, angles[1]);
    if (joint.dof_count > 2) dof_axes[2] = TurnColumns<2>(R_WL, angles[2]);
    out.joints[i] = {X_WP.position + X_WP.axes * joint.p_PJ, R_WL};
  }
  // Place the effectors, which are fixed to their limbs.
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    const LimbFrame& X_WL = out.joints[tree.effectors[e].joint];
    out.effectors[e] = {X_WL.position + X_WL.axes * tree.effectors[e].p_LE, X_WL.axes};
  }
}

TreeFrames ComputeFrames(const KinematicTree& tree, const TreeState& state) {
  TreeFrames frames;
  ComputeFrames(tree, state, frames);
  return frames;
}

}  // namespace etude
