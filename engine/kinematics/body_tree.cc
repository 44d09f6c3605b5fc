#include "engine/kinematics/body_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string_view>
#include <vector>

#include "engine/base/angles.h"
#include "engine/kinematics/limb_lengths.h"

namespace etude {
namespace {

using enum Role;

constexpr std::array<BodyTreeLimb, kBodyTreeJointCount> kLimbs = {{
    {kLeftFoot, kLeftAnkle},
    {kLeftAnkle, kLeftKnee},
    {kLeftKnee, kLeftHip},
    {kLeftHip, kRightHip},
    {kHipCentre, kShoulderCentre},
    {kLeftShoulder, kLeftElbow},
    {kLeftElbow, kLeftWrist},
    {kLeftWrist, kLeftHand},
    {kRightShoulder, kRightElbow},
    {kRightElbow, kRightWrist},
    {kRightWrist, kRightHand},
    {kShoulderCentre, kHead},
    {kRightHip, kRightKnee},
    {kRightKnee, kRightAnkle},
    {kRightAnkle, kRightFoot},
}};

// R_WL of limbs when the body stands at rest, facing +Z. The columns of a matrix are a limb's X, Y and Z axes.
const glm::dvec3 kRight(-1, 0, 0), kUp(0, 1, 0), kForward(0, 0, 1);
const glm::dmat3 kClimbing(kRight, kForward, kUp);
const glm::dmat3 kHipLine(kForward, kUp, kRight);
const glm::dmat3 kHanging(kRight, -kForward, -kUp);
const glm::dmat3 kToeToAnkle(kRight, kUp, -kForward);
const glm::dmat3 kAnkleToToe(kRight, -kUp, kForward);

struct JointRow {
  BodyTreeJoint self;
  std::string_view name;
  int parent;
  glm::dvec3 p_PJ;
  glm::dmat3 R_WJ;                     // axes of the joint at rest
  std::vector<AngleRange> limits_deg;  // one entry per degree of freedom
};

}  // namespace

bool IsValid(const LimbLengths& lengths) {
  return std::ranges::all_of(kLimbLengths, [&](const NamedLength& one) {
    return std::isfinite(lengths.*one.length) && lengths.*one.length > 0;
  });
}

KinematicTree MakeBodyTree(const LimbLengths& lengths) {
  // One row per joint: name, parent, p_PJ, R_WJ at rest, limits in degrees.
  const double half_shoulders = lengths.shoulder_width / 2;
  // clang-format off
  const std::array<JointRow, kBodyTreeJointCount> rows = {{
      {kTreeLeftToe, "left_toe", -1, {0, 0, 0}, kToeToAnkle, {}},
      {kTreeLeftAnkle, "left_ankle", kTreeLeftToe, {0, 0, lengths.foot}, kClimbing, {{-20, 50}}},
      {kTreeLeftKnee, "left_knee", kTreeLeftAnkle, {0, 0, lengths.shank}, kClimbing, {{0, 135}}},
      {kTreeLeftHip, "left_hip", kTreeLeftKnee, {0, 0, lengths.thigh}, kHipLine,
       {{-45, 30}, {-45, 45}, {-120, 30}}},
      {kTreeNavel, "navel", kTreeLeftHip, {0, 0, lengths.hip_width / 2}, kClimbing,
       {{-70, 25}, {-35, 35}, {-45, 45}}},
      {kTreeLeftShoulder, "left_shoulder", kTreeNavel, {-half_shoulders, 0, lengths.trunk}, kHanging,
       {{-50, 170}, {-80, 30}, {-70, 70}}},
      {kTreeLeftElbow, "left_elbow", kTreeLeftShoulder, {0, 0, lengths.upper_arm}, kHanging, {{0, 145}}},
      {kTreeLeftWrist, "left_wrist", kTreeLeftElbow, {0, 0, lengths.forearm}, kHanging,
       {{-70, 80}, {-20, 30}}},
      {kTreeRightShoulder, "right_shoulder", kTreeNavel, {half_shoulders, 0, lengths.trunk}, kHanging,
       {{-50, 170}, {-30, 80}, {-70, 70}}},
      {kTreeRightElbow, "right_elbow", kTreeRightShoulder, {0, 0, lengths.upper_arm}, kHanging,
       {{0, 145}}},
      {kTreeRightWrist, "right_wrist", kTreeRightElbow, {0, 0, lengths.forearm}, kHanging,
       {{-70, 80}, {-30, 20}}},
      {kTreeNeck, "neck", kTreeNavel, {0, 0, lengths.trunk}, kClimbing,
       {{-45, 45}, {-45, 45}, {-60, 60}}},
      {kTreeRightHip, "right_hip", kTreeLeftHip, {0, 0, lengths.hip_width}, kHanging,
       {{-30, 120}, {-30, 45}, {-45, 45}}},
      {kTreeRightKnee, "right_knee", kTreeRightHip, {0, 0, lengths.thigh}, kHanging, {{-135, 0}}},
      {kTreeRightAnkle, "right_ankle", kTreeRightKnee, {0, 0, lengths.shank}, kAnkleToToe,
       {{-50, 20}, {-20, 20}}},
  }};
  // clang-format on

  // Compute each R_PJ from the rest axes of the joint and of its parent.
  KinematicTree tree;
  tree.standing_root = rows[0].R_WJ;
  for (const JointRow& row : rows) {
    assert(row.self == static_cast<int>(tree.joints.size()) && "the rows are in the order of BodyTreeJoint");
    const glm::dmat3 R_PJ = row.parent < 0 ? glm::dmat3(1) : glm::transpose(rows[row.parent].R_WJ) * row.R_WJ;
    tree.joints.push_back(
        {row.name, row.parent, row.p_PJ, R_PJ, tree.dof_count(), static_cast<int>(row.limits_deg.size())});
    for (const AngleRange& range : row.limits_deg) tree.limits.push_back({Radians(range.lower), Radians(range.upper)});
  }
  tree.effectors = {{"right_foot", kTreeRightAnkle, {0, 0, lengths.foot}},
                    {"left_hand", kTreeLeftWrist, {0, 0, lengths.hand}},
                    {"right_hand", kTreeRightWrist, {0, 0, lengths.hand}},
                    {"head", kTreeNeck, {0, 0, lengths.neck}}};
  return tree;
}

std::span<const BodyTreeLimb, kBodyTreeJointCount> BodyTreeLimbs() { return kLimbs; }

namespace {

using enum Role;

// A joint of the clip, with the limb of the tree to which this joint is fixed. Limbs are rigid, so the joint's children
// keep their rest offsets and turn with that limb.
struct ClipJointRow {
  std::string_view name;
  int parent;
  Role role;
  BodyTreeJoint limb;
  bool is_end = false;
};
constexpr std::array<ClipJointRow, 21> kClipJoints = {{
    {"Hips", -1, kHipCentre, kTreeLeftHip},
    {"LowerBack", 0, kHipCentre, kTreeNavel},
    {"Spine", 1, kSpine, kTreeNavel},
    {"Neck", 2, kShoulderCentre, kTreeNeck},
    {"Head", 3, kHead, kTreeNeck},
    {"LeftArm", 2, kLeftShoulder, kTreeLeftShoulder},
    {"LeftForeArm", 5, kLeftElbow, kTreeLeftElbow},
    {"LeftHand", 6, kLeftWrist, kTreeLeftWrist},
    {"LeftHand_End", 7, kLeftHand, kTreeLeftWrist, true},
    {"RightArm", 2, kRightShoulder, kTreeRightShoulder},
    {"RightForeArm", 9, kRightElbow, kTreeRightElbow},
    {"RightHand", 10, kRightWrist, kTreeRightWrist},
    {"RightHand_End", 11, kRightHand, kTreeRightWrist, true},
    {"LeftUpLeg", 0, kLeftHip, kTreeLeftKnee},
    {"LeftLeg", 13, kLeftKnee, kTreeLeftAnkle},
    {"LeftFoot", 14, kLeftAnkle, kTreeLeftToe},
    {"LeftFoot_End", 15, kLeftFoot, kTreeLeftToe, true},
    {"RightUpLeg", 0, kRightHip, kTreeRightHip},
    {"RightLeg", 17, kRightKnee, kTreeRightKnee},
    {"RightFoot", 18, kRightAnkle, kTreeRightAnkle},
    {"RightFoot_End", 19, kRightFoot, kTreeRightAnkle, true},
}};

BodyPose ToBodyPose(const KinematicTree& body, const TreeFrames& frames) {
  BodyPose pose;
  for (std::size_t i = 0; i < body.joints.size(); ++i) pose[BodyTreeLimbs()[i].from] = frames.joints[i].position;
  for (std::size_t e = 0; e < body.effectors.size(); ++e) {
    pose[BodyTreeLimbs()[body.effectors[e].joint].to] = frames.effectors[e].position;
  }
  pose[kSpine] = glm::mix(pose[kHipCentre], pose[kShoulderCentre], kSpineShare);
  return pose;
}

}  // namespace

BodyPose ToBodyPose(const KinematicTree& body, const TreeState& state) {
  return ToBodyPose(body, ComputeFrames(body, state));
}

Clip ToClip(const KinematicTree& body, std::span<const TreeState> states, double rate_hz, const std::string& name) {
  Clip clip;
  clip.name = name;
  clip.rate_hz = rate_hz;
  // Make the skeleton from the offsets between the joints of the rest pose.
  const TreeFrames rest_frames = ComputeFrames(body, StandingState(body));
  const BodyPose rest = ToBodyPose(body, rest_frames);
  for (const ClipJointRow& row : kClipJoints) {
    const glm::dvec3 offset = row.parent < 0 ? glm::dvec3(0) : rest[row.role] - rest[kClipJoints[row.parent].role];
    clip.skeleton.joints.push_back({std::string(row.name), row.parent, {.translation = offset}, row.is_end});
  }

  // In each frame, compute the world rotation of every joint, then its rotation relative to its parent.
  clip.frames.reserve(states.size());
  TreeFrames frames;
  std::array<glm::dquat, kClipJoints.size()> R_WC;  // rotation of each clip joint, identity at rest
  for (const TreeState& state : states) {
    ComputeFrames(body, state, frames);
    LocalPose& pose = clip.frames.emplace_back(kClipJoints.size());
    for (std::size_t i = 0; i < kClipJoints.size(); ++i) {
      const ClipJointRow& row = kClipJoints[i];
      const glm::dmat3 R_LC = glm::transpose(rest_frames.joints[row.limb].axes);
      R_WC[i] = glm::normalize(glm::quat_cast(frames.joints[row.limb].axes * R_LC));
      if (row.parent < 0) {
        pose[i] = {frames.joints[kTreeNavel].position, R_WC[i]};
      } else {
        pose[i] = {clip.skeleton.joints[i].rest.translation, glm::conjugate(R_WC[row.parent]) * R_WC[i]};
      }
    }
  }
  return clip;
}

}  // namespace etude
