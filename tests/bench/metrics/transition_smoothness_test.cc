#include "bench/metrics/transition_smoothness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

constexpr int kFrames = 41;
constexpr int kSeam = 20;
constexpr int kSeams[] = {kSeam};

/// A body whose joints stand on a line, and move together along x as `x_of` says, metres.
template <typename Function>
BodyMotion MotionAlongX(Function x_of) {
  BodyMotion motion;
  for (int f = 0; f < kFrames; ++f) {
    BodyPose pose;
    for (Role role : AllRoles()) pose[role] = {x_of(f), 0.1 * static_cast<double>(Index(role)), 0};
    motion.poses.push_back(pose);
  }
  return motion;
}

TEST(Jump, IsNothingOnASteadyMotion) {
  const TransitionSmoothness smooth = MeasureTransitions(MotionAlongX([](int f) { return 0.05 * f; }), kSeams);
  EXPECT_NEAR(smooth.jump_cm, 0, 1e-10);
  EXPECT_NEAR(smooth.mean_joint_jump_cm, 0, 1e-10);
  EXPECT_NEAR(smooth.jerk_peak_mps3, 0, 1e-7);
  EXPECT_NEAR(smooth.rotation_step_change_deg, 0, 1e-10);
}

// A step of 7 cm has second differences +7 and −7, so a third difference of 14 cm.
TEST(Jump, OfAStepIsItsHeight) {
  const TransitionSmoothness step =
      MeasureTransitions(MotionAlongX([](int f) { return f > kSeam ? 0.07 : 0; }), kSeams);
  EXPECT_NEAR(step.jump_cm, 7, 1e-10);
  EXPECT_NEAR(step.mean_joint_jump_cm, 7, 1e-10);
  EXPECT_NEAR(step.jerk_peak_mps3, 0.14 * 27000, 1e-6);
}

TEST(Jump, OfASteadyAccelerationHasNoJerk) {
  const TransitionSmoothness even = MeasureTransitions(MotionAlongX([](int f) { return 0.001 * f * f; }), kSeams);
  EXPECT_NEAR(even.jump_cm, 0.2, 1e-10);
  EXPECT_NEAR(even.jerk_peak_mps3, 0, 1e-6);
}

TEST(Jump, CountsWithinFiveFramesOfTheSeamOnly) {
  const auto step_after = [](int last) { return MotionAlongX([last](int f) { return f > last ? 0.07 : 0; }); };
  EXPECT_NEAR(MeasureTransitions(step_after(kSeam + 5), kSeams).jump_cm, 7, 1e-10);
  EXPECT_NEAR(MeasureTransitions(step_after(kSeam + 6), kSeams).jump_cm, 0, 1e-10);
  EXPECT_NEAR(MeasureTransitions(step_after(kSeam - 6), kSeams).jump_cm, 7, 1e-10) << "its second frame is inside";
  EXPECT_NEAR(MeasureTransitions(step_after(kSeam - 7), kSeams).jump_cm, 0, 1e-10);
}

TEST(Jump, TakesTheWorstOfTwoSeams) {
  const BodyMotion motion = MotionAlongX([](int f) { return f > 30 ? 0.07 : 0; });
  const int both[] = {5, 30};
  EXPECT_NEAR(MeasureTransitions(motion, std::span(both, 1)).jump_cm, 0, 1e-10);
  EXPECT_NEAR(MeasureTransitions(motion, both).jump_cm, 7, 1e-10);
}

TEST(Jump, OfOneJointAloneIsAveragedByTheMeanOnly) {
  BodyMotion motion = MotionAlongX([](int) { return 0; });
  for (int f = kSeam + 1; f < kFrames; ++f) motion.poses[f][Role::kLeftHand].x += 0.1;
  const TransitionSmoothness one = MeasureTransitions(motion, kSeams);
  EXPECT_NEAR(one.jump_cm, 10, 1e-10);
  EXPECT_NEAR(one.mean_joint_jump_cm, 10.0 / kRoleCount, 1e-10);
}

TEST(RotationStepChange, IsTheChangeOfALimbsTurningSpeed) {
  // The left hand circles the wrist by 3° a frame, from the transition point on by 10° a frame.
  BodyMotion motion = MotionAlongX([](int) { return 0; });
  for (int f = 0; f < kFrames; ++f) {
    const double degrees = f <= kSeam ? 3 * f : 3 * kSeam + 10 * (f - kSeam);
    const double angle = degrees * 3.14159265358979323846 / 180;
    motion.poses[f][Role::kLeftHand] =
        motion.poses[f][Role::kLeftWrist] + 0.1 * glm::dvec3(std::cos(angle), std::sin(angle), 0);
  }
  EXPECT_NEAR(MeasureTransitions(motion, kSeams).rotation_step_change_deg, 7, 1e-9);
}

TEST(NaturalJumps, JudgeEveryUnbrokenWindowOfElevenFrames) {
  const std::vector<double> none = NaturalJumpsCm(MotionAlongX([](int f) { return 0.05 * f; }));
  ASSERT_EQ(none.size(), static_cast<std::size_t>(kFrames - 2 - 10));
  EXPECT_NEAR(NaturalLimitCm(none), 0, 1e-10);
  // Frames 20 and 21 jump, so windows starting at 10 … 21 do: 12 of 29.
  const std::vector<double> some = NaturalJumpsCm(MotionAlongX([](int f) { return f > 20 ? 0.07 : 0; }));
  EXPECT_EQ(std::count_if(some.begin(), some.end(), [](double jump) { return jump > 6.9; }), 12);
  EXPECT_TRUE(NaturalJumpsCm({kJudgedRateHz, std::vector<BodyPose>(12)}).empty());
  EXPECT_EQ(NaturalJumpsCm({kJudgedRateHz, std::vector<BodyPose>(13)}).size(), 1u);
}

TEST(NaturalLimit, IsThe95thPercentile) {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  EXPECT_NEAR(NaturalLimitCm(values), 95, 1e-12);
  EXPECT_NEAR(NaturalLimitCm({0, 1}), 0.95, 1e-12);
}

/// Both feet at height h, moving along x by `step` a frame.
BodyMotion Sliding(double height, double step) {
  BodyMotion motion = MotionAlongX([step](int f) { return step * f; });
  for (BodyPose& pose : motion.poses) pose[Role::kLeftFoot].y = pose[Role::kRightFoot].y = height;
  return motion;
}

TEST(FootSlide, WeighsAFootsSpeedByItsHeight) {
  EXPECT_NEAR(FootSlideCmps(Sliding(0, 0.01), 5), 30, 1e-9);
  EXPECT_NEAR(FootSlideCmps(Sliding(0.0125, 0.01), 5), 30 * (2 - std::sqrt(2.0)), 1e-9);
  EXPECT_NEAR(FootSlideCmps(Sliding(0.025, 0.01), 5), 0, 1e-9) << "lifted feet do not slide";
  EXPECT_NEAR(FootSlideCmps(Sliding(-0.01, 0.01), 5), 30, 1e-9) << "sunken feet count once";
  EXPECT_NEAR(FootSlideCmps(Sliding(0, 0), 5), 0, 1e-9) << "standing feet do not slide";
}

TEST(PoseAndVelocityGap, AreTheWorstJoints) {
  const BodyPose still;
  BodyPose other = still, faster = still;
  other[Role::kHead].y = 0.12;
  other[Role::kSpine].x = 0.05;
  EXPECT_NEAR(PoseGapCm(still, other), 12, 1e-10);
  EXPECT_NEAR(PoseGapCm(still, still), 0, 1e-10);
  faster[Role::kLeftHand].z = 0.02;  // metres in a frame
  EXPECT_NEAR(VelocityGapCmps(still, still, still, faster, 30), 60, 1e-10);
  EXPECT_NEAR(VelocityGapCmps(still, faster, still, faster, 30), 0, 1e-10) << "both move alike";
}

// Nature's yardstick: a motion that goes on meets itself.
TEST(PoseAndVelocityGap, OfUnbrokenMotionAreNothingAndTheSecondDifferenceTimesRate) {
  const BodyMotion motion = MotionAlongX([](int f) { return 0.01 * f * f; });
  const std::vector<BodyPose>& poses = motion.poses;
  EXPECT_EQ(PoseGapCm(poses[kSeam], poses[kSeam]), 0);
  const double gap = VelocityGapCmps(poses[kSeam - 1], poses[kSeam], poses[kSeam], poses[kSeam + 1], motion.rate_hz);
  EXPECT_NEAR(gap, motion.rate_hz * SecondDifferencesCm(motion)[kSeam], 1e-9);
}

}  // namespace
}  // namespace etude
