#include "engine/transitions/in_betweens/tween.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/transitions/base/alignment.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

BodyPose ArmsAt(double degrees) { return StandingClip(1, degrees).poses[0]; }

/// A body with a thigh lifted to the front, elsewhere on the floor and turned.
BodyPose LegLifted() {
  PosedBody body;
  body.left_leg.upper = PosedBody::Raised(70, {0, 0, 1});
  return FloorMove{.yaw = 1.2, .x = 3, .z = -2}.Apply(body.Pose());
}

double Lowest(const BodyPose& pose) {
  double lowest = 1e9;
  for (const glm::dvec3& joint : pose.joints) lowest = std::min(lowest, joint.y);
  return lowest;
}

/// The fastest that any limb turns between two frames, degrees per second.
double FastestTurn(const std::vector<BodyPose>& frames) {
  double fastest = 0;
  for (std::size_t f = 1; f < frames.size(); ++f) {
    for (const Bone& bone : AllBones()) {
      const auto limb = [&](std::size_t frame) { return frames[frame][bone.child] - frames[frame][bone.parent]; };
      fastest = std::max(fastest, Degrees(AngleBetween(limb(f - 1), limb(f))) * kJudgedRateHz);
    }
  }
  return fastest;
}

TEST(Tween, BeginsAndEndsInItsPoses) {
  const Tween tween(ArmsAt(20), LegLifted());
  for (Role role : AllRoles()) EXPECT_NEAR(glm::distance(tween.At(0)[role], ArmsAt(20)[role]), 0, 1e-12);
  EXPECT_NEAR(PoseGap(tween.At(1), LegLifted()), 0, 1e-9);
  EXPECT_NEAR(Heading(tween.At(1)), Heading(ArmsAt(20)), 1e-9) << "the second pose is turned to the first";
}

TEST(Tween, BeginsInATurnedAndBentPose) {
  PosedBody twisted;
  twisted.twist = 0.5;
  const BodyPose from = FloorMove{.yaw = -2.1, .x = 1, .z = 4}.Apply(twisted.Pose());
  const Tween tween(from, ArmsAt(80));
  for (Role role : AllRoles()) EXPECT_NEAR(glm::distance(tween.At(0)[role], from[role]), 0, 1e-12) << RoleName(role);
  EXPECT_NEAR(PoseGap(tween.At(1), ArmsAt(80)), 0, 1e-9);
}

TEST(Tween, TurnsAnArmAlongItsArc) {
  const BodyPose middle = Tween(ArmsAt(10), ArmsAt(90)).At(0.5);
  EXPECT_NEAR(PoseGap(middle, ArmsAt(50)), 0, 1e-9) << "halfway between 10 and 90 degrees";
}

TEST(Tween, KeepsLimbsTheFootAndTheFloor) {
  const BodyPose from = ArmsAt(20), to = LegLifted();
  const Tween tween(from, to);
  const double lowest = std::min(Lowest(from), Lowest(to));
  for (int i = 0; i <= 20; ++i) {
    const BodyPose pose = tween.At(i / 20.0);
    for (const Bone& bone : AllBones()) EXPECT_NEAR(BoneLength(pose, bone), BoneLength(from, bone), 1e-12);
    EXPECT_GE(Lowest(pose), lowest - 1e-12);
    EXPECT_NEAR(glm::distance(pose[Role::kRightAnkle], from[Role::kRightAnkle]), 0, 1e-9) << "the standing leg";
  }
}

TEST(Tween, RisesFromTheFloorInProportion) {
  const BodyPose standing = ArmsAt(20);
  BodyPose jumping = ArmsAt(60);
  for (glm::dvec3& joint : jumping.joints) joint.y += 0.3;
  const Tween tween(standing, jumping);
  for (double part : {0.0, 0.25, 0.5, 1.0}) {
    EXPECT_NEAR(Lowest(tween.At(part)), Lowest(standing) + 0.3 * part, 1e-12) << part;
  }
}

TEST(Tween, SwingsAnArmSidewaysWhenBothWaysAreAsShort) {
  PosedBody hanging, raised;
  raised.left_arm = {{0, 1, 0}, {0, 1, 0}};
  const BodyPose middle = Tween(hanging.Pose(), raised.Pose()).At(0.5);
  const glm::dvec3 arm = middle[Role::kLeftElbow] - middle[Role::kLeftShoulder];
  EXPECT_NEAR(std::abs(arm.x), 0.25, 1e-9);
}

TEST(Tween, OfACollapsedBodyStaysFinite) {
  for (const glm::dvec3& joint : Tween(BodyPose{}, ArmsAt(90)).At(0.5).joints) {
    EXPECT_TRUE(std::isfinite(joint.x) && std::isfinite(joint.y) && std::isfinite(joint.z));
  }
}

TEST(SampledTween, TurnsNoLimbFasterThanTheRulesAllow) {
  const Tween tween(ArmsAt(0), ArmsAt(120));
  const auto frames = SampleTween(tween, kJudgedRateHz, {});
  EXPECT_LE(FastestTurn(frames), 360 + 1e-6);
  EXPECT_GT(FastestTurn(frames), 330) << "and does not dawdle";
  TweenRules hasty;
  hasty.turn_speed = Radians(720);
  EXPECT_GT(FastestTurn(SampleTween(tween, kJudgedRateHz, hasty)), 500) << "the check sees what is too fast";
}

TEST(SampledTween, TakesAtLeastTheShortestTimeAndAtMostTheLongest) {
  const TweenRules rules;
  EXPECT_EQ(SampleTween(Tween(ArmsAt(0), ArmsAt(0)), kJudgedRateHz, rules).size(), 10u) << "0.3 s";
  const Tween half_turn(ArmsAt(0), ArmsAt(180));
  const double longest = LongestTween(rules);
  EXPECT_NEAR(longest, 1.875 / 2, 1e-12) << "half a turn at one turn per second, eased";
  EXPECT_LE(SampleTween(half_turn, kJudgedRateHz, rules).size() - 1.0, std::ceil(longest * kJudgedRateHz));
}

}  // namespace
}  // namespace etude
