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

TEST(AtFrames, FollowsAParabolaAndALineBesideAGap) {
  const auto at = [](double t) { return glm::dvec3(t * t, 1 - 2 * t * t, 3 * t); };
  RawMotion thrown{.rate_hz = 10, .joints = {"a"}};
  for (int f = 0; f < 9; ++f) thrown.positions.push_back(at(f));
  const std::vector<double> frames = {0, 0.3, 1.5, 4.25, 7.9, 8, 8.1, -0.1};
  const RawMotion found = AtFrames(thrown, frames, 10, Inbetween::kCubic);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(glm::distance(found.At(i, 0), at(frames[i])), 1e-12) << frames[i];
  EXPECT_FALSE(IsSeen(found.At(6, 0)) || IsSeen(found.At(7, 0))) << "outside the motion";
  // Beside one gap a parabola through three frames, between two gaps a line.
  thrown.positions[2] = thrown.positions[5] = NotSeen();
  const std::vector<double> beside = {0.5, 3.5, 6.5};
  const RawMotion with_gaps = AtFrames(thrown, beside, 10, Inbetween::kCubic);
  EXPECT_LT(glm::distance(with_gaps.At(2, 0), at(6.5)), 1e-12);
  for (const std::size_t i : {0, 1}) {
    const double a = std::floor(beside[i]);
    EXPECT_LT(glm::distance(with_gaps.At(i, 0), 0.5 * (at(a) + at(a + 1))), 1e-12) << beside[i];
  }
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
