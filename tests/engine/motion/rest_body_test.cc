#include "engine/motion/rest_body.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

using enum Role;

// Returns a pose in which all limbs have the same length, metres. They point up, except that the left hip is beside the
// hip centre.
BodyPose Stretched(double length) {
  BodyPose pose;
  for (const Bone& bone : AllBones()) {
    const glm::dvec3 limb = bone.child == kLeftHip ? glm::dvec3(length, 0, 0) : glm::dvec3(0, length, 0);
    pose[bone.child] = pose[bone.parent] + limb;
  }
  return pose;
}

TEST(RestBody, HasLimbsOfTheirMeanLengthsAndStands) {
  const std::vector<BodyPose> poses = {Stretched(0.1), Stretched(0.12)};
  const RestBody body = RestBodyOf(poses);
  const BodyPose rest = body.Pose();
  for (const Bone& bone : AllBones()) EXPECT_NEAR(BoneLength(rest, bone), 0.11, 1e-12) << RoleName(bone.child);
  EXPECT_GT(rest[kHead].y, rest[kShoulderCentre].y);
  EXPECT_LT(rest[kLeftHand].y, rest[kLeftWrist].y);
  EXPECT_GT(rest[kLeftShoulder].x, rest[kRightShoulder].x);
}

TEST(RestBody, TurnsEveryLimbButThePelvisByItself) {
  const std::vector<BodyPose> poses = {Stretched(0.1)};
  const RestBody body = RestBodyOf(poses);
  EXPECT_EQ(body.joints.size(), 18u) << "nineteen limbs, of which two are the pelvis";
  EXPECT_EQ(body.roles[Index(kLeftHip)].joint, body.roles[Index(kRightHip)].joint);
  for (std::size_t i = 0; i < body.joints.size(); ++i) EXPECT_LT(body.joints[i].parent, static_cast<int>(i));
  EXPECT_NE(body.roles[Index(kLeftShoulder)].joint, body.roles[Index(kHead)].joint);
}

}  // namespace
}  // namespace etude
