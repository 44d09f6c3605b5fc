#include "engine/fuzzy/features.h"

#include <gtest/gtest.h>

#include "tests/engine/fuzzy/posed_body.h"

namespace etude {
namespace {

using enum Feature;

PoseFeatures FeaturesOf(const PosedBody& body) { return ComputeFeatures(body.Pose(), PosedBody::kStandingHipHeight); }

TEST(Features, OfAStandingBodyAreAllAtRest) {
  const PoseFeatures features = FeaturesOf({});
  for (Feature feature : {kRH, kLH, kRHE, kLHE, kRF, kLF}) EXPECT_NEAR(features[feature], 0, 1e-9);
  for (Feature feature : {kTrunk, kRFK, kLFK}) EXPECT_NEAR(features[feature], 180, 1e-9);
  EXPECT_NEAR(features[kPosture], 80, 1e-9);
}

TEST(Features, ReadTheAnglesALimbWasPutAt) {
  PosedBody body{.right_arm = {PosedBody::Raised(120, -kLeftwards), PosedBody::Raised(150, -kLeftwards)}};
  body.left_leg = {PosedBody::Raised(50, kForward), PosedBody::Raised(-20, kForward)};
  const PoseFeatures features = FeaturesOf(body);
  EXPECT_NEAR(features[kRH], 120, 1e-9);
  EXPECT_NEAR(features[kRHE], 30, 1e-9);
  EXPECT_NEAR(features[kLF], 50, 1e-9);
  EXPECT_NEAR(features[kLFK], 180 - 70, 1e-9);
  EXPECT_NEAR(features[kLH], 0, 1e-9) << "the other arm did not move";
  EXPECT_NEAR(features[kRF], 0, 1e-9) << "the other leg did not move";
}

TEST(Features, DoNotChangeWhenTheBodyTurnsAndWalks) {
  PosedBody body{.right_arm = {PosedBody::Raised(70, kForward), kUp}};
  const BodyPose pose = body.Pose();
  const BodyPose moved = FloorMove{.yaw = 2.1, .x = -3, .z = 5}.Apply(pose);
  const PoseFeatures here = ComputeFeatures(pose, 0.9), there = ComputeFeatures(moved, 0.9);
  for (Feature feature : AllFeatures()) EXPECT_NEAR(here[feature], there[feature], 1e-9) << FeatureName(feature);
}

TEST(Features, SeeTheTrunkBendAndNotTheArmsThatBendWithIt) {
  const BodyPose standing = PosedBody().Pose();
  BodyPose bent = standing;
  const glm::dvec3 hips = standing[Role::kHipCentre];
  for (Role role : AllRoles()) {  // everything above the hips leans forward by 40°
    if (Index(role) == 0 || Index(role) >= Index(Role::kLeftHip)) continue;
    const glm::dvec3 v = standing[role] - hips;
    const double c = std::cos(Radians(40)), s = std::sin(Radians(40));
    bent[role] = hips + glm::dvec3(v.x, c * v.y - s * v.z, s * v.y + c * v.z);
  }
  const PoseFeatures features = ComputeFeatures(bent, 0.9);
  EXPECT_NEAR(features[kTrunk], 140, 1e-9);
  EXPECT_NEAR(features[kRH], 0, 1e-9) << "the arm still lies along the trunk";
  EXPECT_NEAR(features[kRF], 40, 1e-9) << "the thigh is now 40 degrees off the trunk's line";
}

TEST(Features, StayFiniteForABodyCollapsedToAPoint) {
  const PoseFeatures features = ComputeFeatures(BodyPose{}, 0.9);
  for (double value : features.values) EXPECT_TRUE(std::isfinite(value));
}

TEST(Features, AreFoundByTheirNames) {
  for (Feature feature : AllFeatures()) {
    ASSERT_NE(FindFeature(FeatureName(feature)), nullptr);
    EXPECT_EQ(*FindFeature(FeatureName(feature)), feature);
    EXPECT_FALSE(JointsOf(feature).empty());
  }
  EXPECT_EQ(FindFeature("rh"), nullptr);
}

TEST(StandingHipHeight, AddsUpStraightLegsWhateverThePose) {
  PosedBody squat;
  squat.left_leg = squat.right_leg = {PosedBody::Raised(80, kForward), PosedBody::Raised(-40, kForward)};
  EXPECT_NEAR(StandingHipHeight(squat.Pose()), StandingHipHeight(PosedBody().Pose()), 1e-12);
  EXPECT_NEAR(StandingHipHeight(PosedBody().Pose()), 0.42 + 0.42 * (1 + 0.039 / 0.246), 1e-12);
}

}  // namespace
}  // namespace etude
