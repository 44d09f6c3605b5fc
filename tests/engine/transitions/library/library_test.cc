#include "engine/transitions/library/library.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

TEST(MotionFeatures, DoNotSeeWhereADanceTakesPlaceNorWhichWayItFaces) {
  const BodyMotion here = WavingClip(40);
  BodyMotion there = here;
  for (BodyPose& pose : there.poses) pose = FloorMove{.yaw = 2, .x = -5, .z = 1}.Apply(pose);
  const BodyMotion clips[] = {here, there};
  const auto features = ComputeMotionFeatures(clips);
  ASSERT_EQ(features.size(), 2u);
  ASSERT_EQ(features[0].size(), 40u);
  for (std::size_t f = 0; f < 40; ++f) {
    for (std::size_t i = 0; i < kMotionFeatureCount; ++i) EXPECT_NEAR(features[0][f][i], features[1][f][i], 1e-9);
  }
}

TEST(MotionFeatures, HaveVectorsOfStandardDeviationOne) {
  const BodyMotion clips[] = {WavingClip(50), WavingClip(70, 2)};
  const auto features = ComputeMotionFeatures(clips);
  constexpr std::size_t kLeftHand = 2;  // the index of its vector; the feet come first
  double variance = 0;
  for (std::size_t axis = 3 * kLeftHand; axis < 3 * kLeftHand + 3; ++axis) {
    double sum = 0, squares = 0;
    for (const auto& clip : features) {
      for (const MotionFeatures& frame : clip) {
        sum += frame[axis];
        squares += frame[axis] * frame[axis];
      }
    }
    variance += squares / 120 - std::pow(sum / 120, 2);
  }
  EXPECT_NEAR(variance / 3, 1, 1e-9);
}

TEST(MotionFeatures, OfABodyThatNeverMovesCountNothing) {
  const BodyMotion clips[] = {StandingClip(10, 30)};
  const auto features = ComputeMotionFeatures(clips);
  ASSERT_EQ(features[0].size(), 10u);
  for (const MotionFeatures& frame : features[0]) {
    for (double value : frame) EXPECT_EQ(value, 0);
  }
}

TEST(MotionFeatures, HoldTheHipsVelocityInTheDirectionOfFacing) {
  // Walks 0.03 m per frame straight ahead, and stops half-way.
  BodyMotion walk;
  for (int f = 0; f < 40; ++f) {
    walk.poses.push_back(
        FloorMove{.yaw = 1, .x = 0.03 * std::sin(1) * std::min(f, 20), .z = 0.03 * std::cos(1) * std::min(f, 20)}.Apply(
            StandingClip(1, 30).poses[0]));
  }
  const BodyMotion clips[] = {walk};
  const auto frames = ComputeMotionFeatures(clips)[0];
  constexpr std::size_t kHips = kMotionFeatureCount - 3;
  EXPECT_NEAR(frames[10][kHips], 0, 1e-9) << "not sideways";
  EXPECT_GT(frames[10][kHips + 2], 1) << "forward";
  EXPECT_NEAR(frames[30][kHips + 2], 0, 1e-9);
  EXPECT_NEAR(frames[0][kHips + 2], frames[10][kHips + 2], 1e-9) << "one-sided where there is no frame before";
  EXPECT_NEAR(frames[20][kHips + 2], frames[10][kHips + 2] / 2, 1e-9) << "central: half of it walks, half stands";
}

TEST(UsualAcceleration, IsWhatNineOfTenFramesKeepTo) {
  BodyMotion motion;
  // x = f² / 2 · 0.02 m, except for a jump in the last step; eleven frames have neighbours.
  for (int f = 0; f < 13; ++f) {
    BodyPose& pose = motion.poses.emplace_back();
    pose[Role::kLeftHand].x = 0.01 * f * f + (f == 12 ? 0.5 : 0);
  }
  EXPECT_NEAR(UsualAcceleration(motion), 0.02, 1e-12);
  motion.poses.resize(2);
  EXPECT_EQ(UsualAcceleration(motion), 0);
}

}  // namespace
}  // namespace etude
