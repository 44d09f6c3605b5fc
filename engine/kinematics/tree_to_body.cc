#include "engine/kinematics/tree_to_body.h"

#include <array>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/limb_lengths.h"

namespace etude {
namespace {

using enum Role;

// The clip's joints: which limb of the tree each moves with. The tree's limbs are rigid, so a joint's children lie
// where they lay at rest, turned with that limb.
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
  const TreeFrames rest_frames = ComputeFrames(body, StandingState(body));
  const BodyPose rest = ToBodyPose(body, rest_frames);
  for (const ClipJointRow& row : kClipJoints) {
    const glm::dvec3 offset = row.parent < 0 ? glm::dvec3(0) : rest[row.role] - rest[kClipJoints[row.parent].role];
    clip.skeleton.joints.push_back({std::string(row.name), row.parent, {.translation = offset}, row.is_end});
  }

  clip.frames.reserve(states.size());
  TreeFrames frames;
  std::array<glm::dquat, kClipJoints.size()> R_WC;  // of each joint of the clip, whose frame is the world's at rest
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
