#include "engine/kinematics/body_tree.h"

#include <array>
#include <cassert>
#include <cmath>
#include <string_view>
#include <vector>

#include "engine/base/angles.h"

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

// R_WL of limbs when the body stands at rest, facing +Z. Columns are X, Y, Z.
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
  glm::dmat3 R_WJ;                     // at rest
  std::vector<AngleRange> limits_deg;  // one entry per degree of freedom
};

}  // namespace

bool IsValid(const LimbLengths& lengths) {
  for (double length : {lengths.foot, lengths.shank, lengths.thigh, lengths.hip_width, lengths.trunk, lengths.neck,
                        lengths.shoulder_width, lengths.upper_arm, lengths.forearm, lengths.hand}) {
    if (!std::isfinite(length) || length <= 0) return false;
  }
  return true;
}

KinematicTree MakeBodyTree(const LimbLengths& lengths) {
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

  KinematicTree tree;
  tree.standing_root = rows[0].R_WJ;
  for (const JointRow& row : rows) {
    assert(row.self == static_cast<int>(tree.joints.size()) && "the rows stand in the order of BodyTreeJoint");
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

}  // namespace etude
