#include "engine/motion/raw_motion.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

RawMotion Striding(double rate_hz, std::size_t frames) {
  RawMotion motion{.rate_hz = rate_hz, .joints = {"a"}};
  for (std::size_t f = 0; f < frames; ++f) motion.positions.emplace_back(static_cast<double>(f), 0, 0);
  return motion;
}

TEST(Sampled, AtTheMotionsOwnRateIsTheMotion) {
  const RawMotion walk = Striding(29.97, 1000);
  EXPECT_EQ(Sampled(walk, 29.97, 0, 1000).positions, walk.positions);
}

TEST(Sampled, LiesOnTheLineBetweenFrames) {
  const RawMotion sampled = Sampled(Striding(30, 3), 120, 0, 9);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(sampled.At(i, 0).x, 0.25 * static_cast<double>(i), 1e-12);
  EXPECT_EQ(sampled.rate_hz, 120);
}

TEST(Sampled, BeginsLater) { EXPECT_NEAR(Sampled(Striding(10, 9), 10, 0.25, 1).At(0, 0).x, 2.5, 1e-12); }

TEST(Sampled, ShowsNothingOutsideTheMotionOrBesideAGap) {
  RawMotion walk = Striding(10, 4);
  walk.positions[2] = NotSeen();
  const RawMotion sampled = Sampled(walk, 20, -0.05, 10);
  // Frames −0.5, 0, 0.5, … 4: the joint is seen up to frame 1, and at frame 3.
  const bool seen[] = {false, true, true, true, false, false, false, true, false, false};
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(IsSeen(sampled.At(i, 0)), seen[i]) << i;
}

TEST(Sampled, TurnsRotationsEvenly) {
  RawMotion turn = Striding(10, 2);
  turn.rotations = {glm::dquat(1, 0, 0, 0), glm::dquat(0, 0, 1, 0)};
  const glm::dquat half = Sampled(turn, 20, 0, 2).rotations[1];
  EXPECT_NEAR(half.w, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(half.y, std::sqrt(0.5), 1e-12);
}

TEST(RawMotion, FindsRolesByRoleAndOtherJointsByName) {
  RawMotion motion = Striding(10, 1);
  motion.joints = {"Left_Knee", "LKNE"};
  EXPECT_EQ(motion.Find("left_knee"), -1) << "a joint named like a role need not be the role's joint";
  motion.roles[Index(Role::kLeftKnee)] = 1;
  EXPECT_EQ(motion.Find("left_knee"), 1);
  EXPECT_EQ(motion.Find("lkne"), 1);
  EXPECT_EQ(motion.Find("nose"), -1);
}

}  // namespace
}  // namespace etude
