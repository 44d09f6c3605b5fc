#include "engine/transitions/library/in_betweens.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/directions.h"
#include "engine/motion/body.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

BodyPose ArmsAt(double degrees) { return StandingClip(1, degrees).poses[0]; }

/// Returns a body with a thigh lifted forward, at another place and heading.
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

/// Returns the fastest turn of a limb between two frames, degrees per second.
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

/// Returns a clip of these levels; a digit per frame gives the class that sets its tags. All are bridge frames.
TaggedClip ClipOfClasses(const std::vector<double>& levels, const std::string& classes) {
  std::vector<int> frames;
  for (std::size_t f = 0; f < levels.size(); ++f) frames.push_back(static_cast<int>(f));
  TaggedClip clip = ClipOfLevels(levels, frames);
  for (std::size_t f = 0; f < levels.size(); ++f) clip.tags[f][0] = static_cast<std::uint8_t>(classes[f] - '0');
  return clip;
}

std::vector<double> LevelsOf(const InBetweenNet& net, const std::vector<TaggedClip>& clips) {
  std::vector<double> levels;
  for (const InBetweenNet::Key& key : net.keys) levels.push_back(clips[key.clip].grades[key.frame][0]);
  return levels;
}

// Number of clips and of frames with each class: 1 and 8 (class 0), 2 and 4 (1), 2 and 5 (2), 3 and 3 (3). Frames of
// different classes are farther apart than the threshold.
TEST(InBetweenNet, TakesItsKeysFromTheMostFrequentPoseToTheRarest) {
  const std::vector<TaggedClip> clips = {
      ClipOfClasses({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0}, "00000000112223"),
      ClipOfClasses({1.0, 1.0, 2.0, 2.0, 3.0}, "11223"), ClipOfClasses({3.0}, "3")};
  EXPECT_EQ(LevelsOf(BuildInBetweens(clips), clips), (std::vector{3.0, 2.0, 1.0, 0.0}))
      << "by clips, and of as many clips by frames";
}

TEST(InBetweenNet, PutsThePoseOfMoreFramesFirstAmongThoseOfAsManyClips) {
  const std::vector<TaggedClip> clips = {ClipOfClasses({1.0, 2.0, 2.0}, "122"), ClipOfClasses({1.0, 2.0}, "12")};
  EXPECT_EQ(LevelsOf(BuildInBetweens(clips), clips), (std::vector{2.0, 1.0}));
}

TEST(InBetweenNet, TakesTheMostTypicalFrameOfAPoseForItsKey) {
  // RMS distances to the other clips' frames: 0.26, 0.18, 0.36, all within the threshold.
  const std::vector<TaggedClip> clips = {ClipOfClasses({1.00}, "1"), ClipOfClasses({1.05}, "1"),
                                         ClipOfClasses({1.30}, "1")};
  EXPECT_EQ(LevelsOf(BuildInBetweens(clips), clips), std::vector{1.05});
}

TEST(InBetweenNet, HasAKeyNearEveryBridgeFrameAndNoTwoKeysNearEachOther) {
  std::vector<TaggedClip> clips;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> levels;
    for (int f = 0; f < 40; ++f) levels.push_back(2 + 2 * std::sin(0.3 * f + c));
    clips.push_back(ClipOfClasses(levels, std::string(40, '1')));
  }
  for (double threshold : {0.2, 0.4, 1.0}) {
    const std::vector<double> keys = LevelsOf(BuildInBetweens(clips, {.threshold = threshold, .tween = {}}), clips);
    for (const TaggedClip& clip : clips) {
      for (const Grades& frame : clip.grades) {
        double nearest = 1e9;
        for (double key : keys) nearest = std::min(nearest, std::abs(key - frame[0]));
        EXPECT_LT(nearest, threshold);
      }
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) EXPECT_GE(std::abs(keys[i] - keys[k]), threshold);
    }
    EXPECT_GE(keys.size(), 4 / (2 * threshold)) << "levels from 0 to 4";
  }
}

TEST(InBetweenNet, IsMadeOfBridgeFramesWhereThereAreAnyElseOfAllFrames) {
  std::vector<TaggedClip> clips = {ClipOfClasses({0, 5, 9}, "111"), ClipOfClasses({0, 5, 9}, "111")};
  clips[0].bridge_frames = {1};
  clips[1].bridge_frames = {};
  EXPECT_EQ(LevelsOf(BuildInBetweens(clips), clips), std::vector{5.0});
  clips[0].bridge_frames = {};
  EXPECT_EQ(BuildInBetweens(clips).keys.size(), 3u);
}

TEST(InBetweenNet, TakesAtMostTwoOfTheLongestTweensInWholeFrames) {
  // Half a turn, eased, lasts 1.875 / 2 s at one turn a second: 28.125 frames at 30 Hz, so 29.
  EXPECT_NEAR(LongestInBetween({}, 30), 2 * 29 / 30.0, 1e-12);
}

}  // namespace

}  // namespace etude
