#include "sim/choreography/canonical_body.h"

#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "engine/fuzzy/features.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

using Body = CanonicalBody;
using enum Role;
using enum SideControl;
using enum MiddleControl;

Controls RandomControls(RandomStream& random) {
  Controls controls;
  for (std::size_t i = 0; i < kMiddleControlCount; ++i) {
    controls.values[i] = random.Uniform(-0.5, 0.5) * (i < 3 ? 0.2 : 1);
  }
  controls[kJump] = random.Uniform(0, 0.2);
  for (Side side : {Side::kLeft, Side::kRight}) {
    for (SideControl angle : {kArmForward, kArmSide, kArmTwist, kElbow, kWrist, kLegForward, kLegSide}) {
      controls.Of(side, angle) = random.Uniform(-0.4, 1.6);
    }
    controls.Of(side, kKnee) = random.Uniform(0, 1.8);
    controls.Of(side, kLegFree) = random.Uniform();
    controls.Of(side, kFootSide) = random.Uniform(-0.1, 0.2);
    controls.Of(side, kFootHeel) = random.Uniform(0, 0.6);
  }
  return controls;
}

TEST(CanonicalBody, KeepsItsLimbLengthsInEveryPose) {
  RandomStream random({}, "poses");
  const BodyPose rest = StandingPose();
  for (int i = 0; i < 500; ++i) {
    const BodyPose pose = PoseOf(RandomControls(random));
    for (const Bone& bone : AllBones()) {
      ASSERT_NEAR(BoneLength(pose, bone), BoneLength(rest, bone), 1e-9) << RoleName(bone.child);
    }
  }
}

TEST(CanonicalBody, MirroredControlsGiveTheMirroredPose) {
  RandomStream random({}, "mirror");
  for (int i = 0; i < 200; ++i) {
    const Controls controls = RandomControls(random);
    const BodyPose pose = PoseOf(controls), mirrored = PoseOf(Mirrored(controls));
    for (Role role : AllRoles()) {
      const glm::dvec3 expected = pose[role] * glm::dvec3(-1, 1, 1);
      ASSERT_LT(glm::distance(mirrored[Mirrored(role)], expected), 1e-9) << RoleName(role);
    }
  }
}

TEST(CanonicalBody, StandsUprightWithArmsHangingAtRest) {
  const BodyPose pose = StandingPose();
  const PoseFeatures features = ComputeFeatures(pose, StandingHipHeight(pose));
  for (Feature feature : {Feature::kRH, Feature::kLH, Feature::kRHE, Feature::kLHE}) {
    EXPECT_NEAR(features[feature], 0, 1e-6) << FeatureName(feature);
  }
  EXPECT_NEAR(features[Feature::kTrunk], 180, 1e-6);
  EXPECT_NEAR(features[Feature::kPosture], 80, 1);
  EXPECT_GT(features[Feature::kRFK], 160);
  EXPECT_GT(pose[kLeftHip].x, 0) << "left is +X";
  EXPECT_GT(pose[kLeftFoot].z, pose[kLeftAnkle].z) << "toes point forward, +Z";
}

TEST(CanonicalBody, ArmAnglesMeanWhatTheySay) {
  const auto arm = [](double forward, double side, double twist, double elbow) {
    Controls controls;
    controls.Of(Side::kLeft, kArmForward) = Radians(forward);
    controls.Of(Side::kLeft, kArmSide) = Radians(side);
    controls.Of(Side::kLeft, kArmTwist) = Radians(twist);
    controls.Of(Side::kLeft, kElbow) = Radians(elbow);
    const BodyPose pose = PoseOf(controls);
    return std::pair((pose[kLeftElbow] - pose[kLeftShoulder]) / Body::kUpperArm,
                     (pose[kLeftWrist] - pose[kLeftElbow]) / Body::kForearm);
  };
  const auto expect_near = [](const glm::dvec3& actual, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(actual, expected), 1e-9) << actual.x << " " << actual.y << " " << actual.z;
  };
  expect_near(arm(90, 0, 0, 0).first, {0, 0, 1});
  expect_near(arm(0, 90, 0, 0).first, {1, 0, 0});
  expect_near(arm(180, 0, 0, 0).first, {0, 1, 0});
  expect_near(arm(0, 0, 0, 90).second, {0, 0, 1});
  expect_near(arm(0, 90, 90, 90).second, {0, 1, 0});
  expect_near(arm(0, 90, -90, 90).second, {0, -1, 0});
}

TEST(CanonicalBody, AStandingFootStaysOnItsSpotWhateverTheHipsDo) {
  const BodyPose rest = PoseOf(ReadyStance());
  RandomStream random({}, "hips");
  for (int i = 0; i < 500; ++i) {
    Controls controls = ReadyStance();
    controls[kHipsSide] = random.Uniform(-0.2, 0.2);
    controls[kHipsAhead] = random.Uniform(-0.15, 0.15);
    controls[kHipsDrop] = random.Uniform(-0.1, 0.3);
    controls[kHipsTurn] = random.Uniform(-0.5, 0.5);
    controls[kHipsTilt] = random.Uniform(-0.3, 0.3);
    const BodyPose pose = PoseOf(controls);
    for (Role role : {kLeftAnkle, kLeftFoot, kRightAnkle, kRightFoot}) {
      ASSERT_LT(glm::distance(pose[role], rest[role]), 1e-9) << RoleName(role);
    }
  }
}

TEST(CanonicalBody, AFreeLegFollowsItsAngles) {
  Controls controls;
  controls.Of(Side::kRight, kLegFree) = 1;
  controls.Of(Side::kRight, kLegForward) = Radians(90);
  controls.Of(Side::kRight, kKnee) = Radians(90);
  const BodyPose pose = PoseOf(controls);
  const glm::dvec3 thigh = pose[kRightKnee] - pose[kRightHip], shank = pose[kRightAnkle] - pose[kRightKnee];
  EXPECT_LT(glm::distance(thigh, {0, 0, Body::kThigh}), 1e-9);
  EXPECT_LT(glm::distance(shank, {0, -Body::kShank, 0}), 1e-9);
}

TEST(CanonicalBody, NoFootGoesThroughTheFloor) {
  RandomStream random({}, "floor");
  for (int i = 0; i < 500; ++i) {
    Controls controls = ReadyStance();
    controls[kHipsDrop] = random.Uniform(0, 0.3);
    controls.Of(Side::kLeft, kLegFree) = random.Uniform();
    controls.Of(Side::kLeft, kLegForward) = random.Uniform(-0.5, 1.5);
    controls.Of(Side::kLeft, kFootPoint) = random.Uniform(-0.3, 1.0);
    const BodyPose pose = PoseOf(controls);
    ASSERT_GE(pose[kLeftFoot].y, Body::kToeHeight - 1e-9);
    ASSERT_GE(pose[kLeftAnkle].y, Body::kAnkleHeight - 1e-9);
  }
}

}  // namespace
}  // namespace etude
