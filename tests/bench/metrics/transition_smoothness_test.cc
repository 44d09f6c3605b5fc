#include "bench/metrics/transition_smoothness.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

constexpr int kFrames = 41;
constexpr int kSeam = 20;
constexpr int kSeams[] = {kSeam};

/// Returns a body whose joints lie on a line and move together along x by `x_of(frame)`, metres.
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

TEST(Jump, CountsFromFiveFramesBeforeTheSeamOn) {
  const auto step_after = [](int last) { return MotionAlongX([last](int f) { return f > last ? 0.07 : 0; }); };
  EXPECT_NEAR(MeasureTransitions(step_after(kSeam - 6), kSeams).jump_cm, 7, 1e-10) << "its second frame is inside";
  EXPECT_NEAR(MeasureTransitions(step_after(kSeam - 7), kSeams).jump_cm, 0, 1e-10);
}

TEST(NaturalJumps, JudgeEveryUnbrokenWindowOfElevenFrames) {
  const std::vector<double> none = NaturalJumpsCm(MotionAlongX([](int f) { return 0.05 * f; }));
  ASSERT_EQ(none.size(), static_cast<std::size_t>(kFrames - 2 - 10));
  EXPECT_NEAR(NaturalLimitCm(none), 0, 1e-10);
  // Frames 20 and 21 jump, so the windows that start at 10 … 21 contain a jump: 12 of 29.
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

}  // namespace
}  // namespace etude
