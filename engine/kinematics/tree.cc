#include "engine/kinematics/tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/kinematics/euler.h"
#include "engine/kinematics/sine_cosine.h"

namespace etude {
namespace {

// The frames that limbs have when the body stands at rest, facing +Z. Columns are X, Y, Z.
const glm::dvec3 kRight(-1, 0, 0), kUp(0, 1, 0), kForward(0, 0, 1);
const glm::dmat3 kClimbing(kRight, kForward, kUp);
const glm::dmat3 kHipLine(kForward, kUp, kRight);
const glm::dmat3 kHanging(kRight, -kForward, -kUp);
const glm::dmat3 kToeToAnkle(kRight, kUp, -kForward);
const glm::dmat3 kAnkleToToe(kRight, -kUp, kForward);

struct JointRow {
  BodyTreeJoint self;
  std::string_view name;
  Role role;
  int parent;
  glm::dvec3 offset;
  glm::dmat3 standing;                 // its limb's frame at rest, in the world
  std::vector<AngleRange> limits_deg;  // one entry per degree of freedom
};

/// axes · R, the rotation by `angle` about coordinate axis `kAxis`. Returns the axis, which stays.
template <int kAxis>
glm::dvec3 TurnColumns(glm::dmat3& axes, double angle) {
  constexpr int i = (kAxis + 1) % 3, j = (kAxis + 2) % 3;
  const auto [s, c] = ComputeSineCosine(angle);
  const glm::dvec3 x = axes[i], y = axes[j];
  axes[i] = c * x + s * y;
  axes[j] = c * y - s * x;
  return axes[kAxis];
}

}  // namespace

bool IsValid(const LimbLengths& lengths) {
  for (double length : {lengths.foot, lengths.shank, lengths.thigh, lengths.hip_width, lengths.trunk, lengths.neck,
                        lengths.shoulder_width, lengths.upper_arm, lengths.forearm, lengths.hand}) {
    if (!std::isfinite(length) || length <= 0) return false;
  }
  return true;
}

double ClampAngle(double angle, const AngleRange& range) {
  if (angle >= range.lower && angle <= range.upper) return angle;
  const double middle = 0.5 * (range.lower + range.upper);
  return std::clamp(middle + std::remainder(angle - middle, 2 * kPi), range.lower, range.upper);
}

KinematicTree MakeBodyTree(const LimbLengths& lengths) {
  using enum Role;
  const double half_shoulders = lengths.shoulder_width / 2;
  // clang-format off
  const std::array<JointRow, kBodyTreeJointCount> rows = {{
      {kTreeLeftToe, "left_toe", kLeftFoot, -1, {0, 0, 0}, kToeToAnkle, {}},
      {kTreeLeftAnkle, "left_ankle", kLeftAnkle, kTreeLeftToe, {0, 0, lengths.foot}, kClimbing, {{-20, 50}}},
      {kTreeLeftKnee, "left_knee", kLeftKnee, kTreeLeftAnkle, {0, 0, lengths.shank}, kClimbing, {{0, 135}}},
      {kTreeLeftHip, "left_hip", kLeftHip, kTreeLeftKnee, {0, 0, lengths.thigh}, kHipLine,
       {{-30, 45}, {-45, 45}, {-120, 30}}},
      {kTreeNavel, "navel", kHipCentre, kTreeLeftHip, {0, 0, lengths.hip_width / 2}, kClimbing,
       {{-70, 25}, {-35, 35}, {-45, 45}}},
      {kTreeLeftShoulder, "left_shoulder", kLeftShoulder, kTreeNavel, {-half_shoulders, 0, lengths.trunk}, kHanging,
       {{-50, 170}, {-80, 30}, {-70, 70}}},
      {kTreeLeftElbow, "left_elbow", kLeftElbow, kTreeLeftShoulder, {0, 0, lengths.upper_arm}, kHanging, {{0, 145}}},
      {kTreeLeftWrist, "left_wrist", kLeftWrist, kTreeLeftElbow, {0, 0, lengths.forearm}, kHanging,
       {{-70, 80}, {-30, 20}}},
      {kTreeRightShoulder, "right_shoulder", kRightShoulder, kTreeNavel, {half_shoulders, 0, lengths.trunk}, kHanging,
       {{-50, 170}, {-30, 80}, {-70, 70}}},
      {kTreeRightElbow, "right_elbow", kRightElbow, kTreeRightShoulder, {0, 0, lengths.upper_arm}, kHanging,
       {{0, 145}}},
      {kTreeRightWrist, "right_wrist", kRightWrist, kTreeRightElbow, {0, 0, lengths.forearm}, kHanging,
       {{-70, 80}, {-20, 30}}},
      {kTreeNeck, "neck", kShoulderCentre, kTreeNavel, {0, 0, lengths.trunk}, kClimbing,
       {{-45, 45}, {-45, 45}, {-60, 60}}},
      {kTreeRightHip, "right_hip", kRightHip, kTreeLeftHip, {0, 0, lengths.hip_width}, kHanging,
       {{-30, 120}, {-30, 45}, {-45, 45}}},
      {kTreeRightKnee, "right_knee", kRightKnee, kTreeRightHip, {0, 0, lengths.thigh}, kHanging, {{-135, 0}}},
      {kTreeRightAnkle, "right_ankle", kRightAnkle, kTreeRightKnee, {0, 0, lengths.shank}, kAnkleToToe,
       {{-50, 20}, {-20, 20}}},
  }};
  // clang-format on

  KinematicTree tree;
  tree.standing_root = rows[0].standing;
  for (const JointRow& row : rows) {
    assert(row.self == static_cast<int>(tree.joints.size()) && "the rows stand in the order of BodyTreeJoint");
    const glm::dmat3 rest = row.parent < 0 ? glm::dmat3(1) : glm::transpose(rows[row.parent].standing) * row.standing;
    tree.joints.push_back(
        {row.name, row.role, row.parent, row.offset, rest, tree.dof_count(), static_cast<int>(row.limits_deg.size())});
    for (const AngleRange& range : row.limits_deg) tree.limits.push_back({Radians(range.lower), Radians(range.upper)});
  }
  tree.effectors = {{"right_foot", kRightFoot, kTreeRightAnkle, {0, 0, lengths.foot}},
                    {"left_hand", kLeftHand, kTreeLeftWrist, {0, 0, lengths.hand}},
                    {"right_hand", kRightHand, kTreeRightWrist, {0, 0, lengths.hand}},
                    {"head", kHead, kTreeNeck, {0, 0, lengths.neck}}};
  return tree;
}

TreeState StandingState(const KinematicTree& tree) {
  return {glm::dvec3(0), tree.standing_root, std::vector<double>(tree.limits.size(), 0.0)};
}

glm::dvec3 JointAngles(const TreeJoint& joint, std::span<const double> angles) {
  glm::dvec3 xyz(0);
  for (int axis = 0; axis < joint.dof_count; ++axis) xyz[axis] = angles[joint.first_dof + axis];
  return xyz;
}

glm::dvec3 DofAxis(const TreeJoint& joint, const glm::dmat3& base, std::span<const double> angles, int axis) {
  if (axis == 0) return base[0];
  const glm::dvec3 q = JointAngles(joint, angles);
  // X turns the Y axis; X and Y turn the Z axis.
  const double cx = std::cos(q.x), sx = std::sin(q.x);
  if (axis == 1) return base * glm::dvec3(0, cx, sx);
  const double cy = std::cos(q.y), sy = std::sin(q.y);
  return base * glm::dvec3(sy, -sx * cy, cx * cy);
}

void ComputeFrames(const KinematicTree& tree, const TreeState& state, TreeFrames& out) {
  assert(state.angles.size() == tree.limits.size());
  out.joints.resize(tree.joints.size());
  out.bases.resize(tree.joints.size());
  out.dof_axes.resize(tree.limits.size());
  out.effectors.resize(tree.effectors.size());
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    const TreeJoint& joint = tree.joints[i];
    if (joint.parent < 0) {
      out.joints[i] = {state.root_position, state.root_frame};
      out.bases[i] = state.root_frame;
      continue;
    }
    const LimbFrame& above = out.joints[joint.parent];
    glm::dmat3 axes = above.axes * joint.rest;
    out.bases[i] = axes;
    const double* angles = state.angles.data() + joint.first_dof;
    glm::dvec3* dof_axes = out.dof_axes.data() + joint.first_dof;
    if (joint.dof_count > 0) dof_axes[0] = TurnColumns<0>(axes, angles[0]);
    if (joint.dof_count > 1) dof_axes[1] = TurnColumns<1>(axes, angles[1]);
    if (joint.dof_count > 2) dof_axes[2] = TurnColumns<2>(axes, angles[2]);
    out.joints[i] = {above.position + above.axes * joint.offset, axes};
  }
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    const LimbFrame& limb = out.joints[tree.effectors[e].joint];
    out.effectors[e] = {limb.position + limb.axes * tree.effectors[e].offset, limb.axes};
  }
}

TreeFrames ComputeFrames(const KinematicTree& tree, const TreeState& state) {
  TreeFrames frames;
  ComputeFrames(tree, state, frames);
  return frames;
}

}  // namespace etude
