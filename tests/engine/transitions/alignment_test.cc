#include <gtest/gtest.h>

#include "engine/motion/body.h"
#include "tests/engine/transitions/expect_pose.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

TEST(AlignOnFloor, UndoesATurnAndAWalk) {
  const BodyPose pose = WavingClip(1).poses[0];
  const BodyPose moved = FloorMove{.yaw = 2.5, .x = -3, .z = 7}.Apply(pose);
  ExpectSamePose(AlignOnFloor(moved, pose).Apply(moved), pose, 1e-12);
  EXPECT_NEAR(PoseGap(pose, moved), 0, 1e-12);
}

TEST(AlignOnFloor, KeepsHeightsAndLimbs) {
  const BodyPose high = [] {
    BodyPose pose = WavingClip(30).poses[29];
    for (glm::dvec3& joint : pose.joints) joint.y += 0.2;
    return pose;
  }();
  const BodyPose moved = AlignOnFloor(high, StandingClip(1, 0).poses[0]).Apply(high);
  ExpectSameLimbs({kJudgedRateHz, {moved}}, high);
  for (Role role : AllRoles()) EXPECT_EQ(moved[role].y, high[role].y);
}

TEST(PoseGap, IsTheWorstJoint) {
  const BodyPose pose = StandingClip(1, 0).poses[0];
  BodyPose other = pose;
  other[Role::kLeftHand].y += 0.3;
  other[Role::kRightFoot].y += 0.1;
  EXPECT_NEAR(PoseGap(pose, other), 0.3, 1e-12);
}

}  // namespace
}  // namespace etude
