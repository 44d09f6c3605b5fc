#include "engine/motion/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/angles.h"
#include "tests/engine/motion/standing_body.h"

namespace etude {
namespace {

using enum Role;

/// Returns the standing body per frame, altered by `change(pose, seconds)`.
template <typename Change>
BodyMotion Moving(int frames, Change change, double rate_hz = 30) {
  BodyMotion motion{.rate_hz = rate_hz, .poses = {}};
  for (int f = 0; f < frames; ++f) {
    BodyPose pose = Standing();
    change(pose, f / rate_hz);
    motion.poses.push_back(pose);
  }
  return motion;
}

void Shift(BodyPose& pose, const glm::dvec3& by) {
  for (glm::dvec3& joint : pose.joints) joint += by;
}

TEST(Stature, IsTheWayAlongTheLimbsOverItsShare) {
  BodyPose pose = Standing();
  EXPECT_NEAR(Stature(pose), (0.8 + 0.7) / 0.92, 1e-12);
  // Sitting down does not change the stature.
  pose[kLeftKnee] = pose[kLeftHip] + glm::dvec3(0, 0, 0.4);
  pose[kLeftAnkle] = pose[kLeftKnee] - glm::dvec3(0, 0.4, 0);
  EXPECT_NEAR(Stature(pose), (0.8 + 0.7) / 0.92, 1e-12);
}

TEST(ComputeStatistics, MeasuresABodyThatIsCarriedAlong) {
  const MotionStatistics found = ComputeStatistics(Moving(31, [](BodyPose& pose, double t) {
    Shift(pose, {0.3 * t, 0.02, -0.4 * t});
  }));
  EXPECT_NEAR(found.stature_m, 1.5 / 0.92, 1e-12);
  EXPECT_NEAR(found.travelled_m, 0.5, 1e-12);
  EXPECT_NEAR(found.speed_median_m_s, 0.5, 1e-12);
  EXPECT_NEAR(found.speed_p95_m_s, 0.5, 1e-12);
  EXPECT_NEAR(found.speed_peak_m_s, 0.5, 1e-12);
  EXPECT_NEAR(found.foot_slide.mean.value(), 0.5, 1e-12);
  EXPECT_NEAR(found.lowest_foot_m, 0.02, 1e-12);
}

TEST(ComputeStatistics, NamesTheFastestJointAndOrdersTheSpeeds) {
  // The hand's speed rises by 0.1 m/s per frame, from 0.1 to 10 m/s.
  const MotionStatistics found = ComputeStatistics(Moving(101, [](BodyPose& pose, double t) {
    const double f = std::round(30 * t);
    pose[kRightHand].y += 0.1 / 30 * f * (f + 1) / 2;
  }));
  EXPECT_EQ(found.fastest, kRightHand);
  EXPECT_NEAR(found.speed_peak_m_s, 10, 1e-9);
  EXPECT_NEAR(found.speed_median_m_s, 5.05, 1e-9);
  EXPECT_NEAR(found.speed_p95_m_s, 9.505, 1e-9);
  EXPECT_EQ(found.travelled_m, 0);
  EXPECT_EQ(found.foot_slide.mean, 0);
}

TEST(ComputeStatistics, GivesNoSpeedsForASingleFrame) {
  const MotionStatistics found = ComputeStatistics({.rate_hz = 30, .poses = {Standing()}});
  EXPECT_EQ(found.speed_peak_m_s, 0);
  EXPECT_EQ(found.speed_median_m_s, 0);
  EXPECT_EQ(found.foot_slide.mean, 0);
  EXPECT_NEAR(found.stature_m, 1.5 / 0.92, 1e-12);
}

TEST(FootSlide, OfAStiffBodyThatGlidesIsItsSpeedWhereverTheFloorIs) {
  for (const double floor : {0.0, -3.0, 0.7}) {
    for (const double speed : {0.1, 1.0, 3.0}) {
      const auto glide = [&](BodyPose& pose, double t) { Shift(pose, {speed * t, floor, 0}); };
      for (const double rate : {30, 120}) {
        const FootSlide slide = MeasureFootSlide(Moving(20, glide, rate));
        EXPECT_NEAR(slide.mean.value(), speed, 1e-9);
        EXPECT_NEAR(slide.of_foot[0].value(), speed, 1e-9);
        EXPECT_EQ(slide.stance_share, (std::array{1.0, 1.0}));
      }
    }
  }
}

TEST(FootSlide, IsNotMovedByOneLowFrame) {
  BodyMotion glide = Moving(60, [](BodyPose& pose, double t) { Shift(pose, {t, 0, 0}); });
  Shift(glide.poses[20], {0, -0.3, 0});
  EXPECT_NEAR(MeasureFootSlide(glide).mean.value(), 1, 1e-9);
}

TEST(FootSlide, IsToldOfEitherFoot) {
  const FootSlide slide = MeasureFootSlide(Moving(20, [](BodyPose& pose, double t) { pose[kLeftFoot].z += 0.1 * t; }));
  EXPECT_NEAR(slide.of_foot[0].value(), 0.1, 1e-12);
  EXPECT_NEAR(slide.of_foot[1].value(), 0, 1e-12);
  EXPECT_NEAR(slide.mean.value(), 0.05, 1e-12);
  const FootSlide lifted = MeasureFootSlide(Moving(20, [](BodyPose& pose, double t) {
    for (const Role joint : {kLeftFoot, kLeftAnkle}) pose[joint] += glm::dvec3(t, 0.4, 0);
  }));
  EXPECT_FALSE(lifted.of_foot[0]) << "a foot that never stands has none";
  EXPECT_EQ(lifted.of_foot[1], 0);
  EXPECT_EQ(lifted.stance_share, (std::array{0.0, 1.0}));
}

TEST(FootSlide, IsNothingWhereFeetStandWhileTheBodyMoves) {
  const FootSlide slide = MeasureFootSlide(Moving(20, [](BodyPose& pose, double t) {
    const BodyPose before = pose;
    Shift(pose, {t, 0, -2 * t});
    for (const Role foot : {kLeftFoot, kRightFoot}) pose[foot] = before[foot];
  }));
  EXPECT_EQ(slide.mean, 0);
}

TEST(FootSlide, CountsNoFlight) {
  // 2 m/s forward, in the air for the middle third of the time.
  const FootSlide slide = MeasureFootSlide(Moving(90, [](BodyPose& pose, double t) {
    const double flown = std::clamp(t - 1, 0.0, 1.0);
    Shift(pose, {0, 0.5 * std::sin(kPi * flown), 2 * flown});
  }));
  EXPECT_LT(slide.mean.value(), 0.2);
  EXPECT_NEAR(slide.stance_share[0], 2.0 / 3, 0.05);
}

/// Each foot swings forward by 0.6 m and up by 0.15 m in half a second, and stands in the next; the feet alternate.
void Walk(BodyPose& pose, double t) {
  const auto way = [](double seconds) {
    const double step = std::floor(seconds);
    const double swing = std::min(2 * (seconds - step), 1.0);
    return 0.6 * (step + (1 - std::cos(kPi * swing)) / 2);
  };
  const auto height = [](double seconds) {
    const double swing = std::min(2 * (seconds - std::floor(seconds)), 1.0);
    return 0.15 * std::sin(kPi * swing);
  };
  pose[kLeftFoot] += glm::dvec3(0, height(t), way(t));
  pose[kRightFoot] += glm::dvec3(0, height(t + 0.5), way(t + 0.5));
}

TEST(FootSlide, IsSmallInAWalkAndGrowsBySlidingOfTheWhole) {
  const BodyMotion walk = Moving(121, Walk);
  // Feet move while they leave the floor: some cm/s, of a walk of 60 cm/s.
  EXPECT_LT(MeasureFootSlide(walk).mean.value(), 0.03);
  EXPECT_GT(MeasureFootSlide(walk).stance_share[0], 0.4);
  BodyMotion sliding = walk;
  for (std::size_t f = 0; f < sliding.poses.size(); ++f) Shift(sliding.poses[f], {0, 0, -0.6 * f / 30.0});
  EXPECT_GT(MeasureFootSlide(sliding).mean.value(), 0.4);
}

}  // namespace
}  // namespace etude
