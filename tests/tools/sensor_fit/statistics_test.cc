#include "tools/sensor_fit/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/sensor_fit/small_recording.h"

// Statistics of recordings with known errors, each against its closed form.

namespace etude {
namespace {

using enum Role;

constexpr std::size_t kFrames = 4000;
constexpr double kDepth = 3;

/// Returns a still body in front of a sensor at the origin; `error` adds to each joint.
template <typename Error>
std::pair<JointRecording, TwinMatch> Standing(const Error& error) {
  const BodyPose pose = LoadBuiltinMove("sway")->motion.poses.front();
  JointRecording recording{.rate_hz = 30, .frames = {}, .sensor_at = glm::dvec3(0)};
  TwinMatch match;
  for (std::size_t t = 0; t < kFrames; ++t) {
    RolePositions truth, sensed;
    for (const Role role : AllRoles()) {
      truth[Index(role)] = pose[role] + glm::dvec3(0, -1, kDepth);
      sensed[Index(role)] = *truth[Index(role)] + error(t, role);
    }
    recording.frames.push_back(sensed);
    match.truth.push_back(truth);
  }
  return {recording, match};
}

struct Dice {
  RandomStream stream{{.suite_seed = 1, .scenario = "statistics", .trial = 0}, "made-up"};
};

TEST(SensorStatistics, GiveErrorsTheirRootMeanSquare) {
  Dice dice;
  const auto [recording, match] = Standing([&](std::size_t, Role role) {
    return (GroupOf(role) == JointGroup::kKnees ? 0.02 : 0.005) * dice.stream.Normal3();
  });
  const SensorStatistics s = StatisticsOf(recording, &match);
  EXPECT_NEAR(*s.error_mm[Index(JointGroup::kKnees)], 20 * std::sqrt(3.0), 0.7);
  EXPECT_NEAR(*s.error_mm[Index(JointGroup::kTorso)], 5 * std::sqrt(3.0), 0.2);
  EXPECT_NEAR(*s.planted_feet_mm, 5 * std::sqrt(3.0), 0.2);
  EXPECT_NEAR(*s.depth_ratio[Index(JointGroup::kKnees)], 1, 0.03);
  EXPECT_NEAR(*s.correlation[Index(BoneKind::kShank)], 0, 0.04);
}

TEST(SensorStatistics, TellDepthFromWhatIsAcrossTheLineOfSight) {
  Dice dice;
  const auto [recording, match] = Standing([&](std::size_t, Role) {
    const glm::dvec3 thrown = dice.stream.Normal3();
    return 0.001 * glm::dvec3(thrown.x, thrown.y, 1.5 * thrown.z);
  });
  const SensorStatistics s = StatisticsOf(recording, &match);
  EXPECT_NEAR(*s.depth_ratio[Index(JointGroup::kTorso)], 1.5, 0.05);
  JointRecording nowhere = recording;
  nowhere.sensor_at.reset();
  EXPECT_FALSE(StatisticsOf(nowhere, &match).depth_ratio[Index(JointGroup::kTorso)]);
}

TEST(SensorStatistics, CorrelateTheErrorsAtBothEndsOfABone) {
  Dice dice;
  std::array<glm::dvec3, kRoleCount> unit;
  const auto [recording, match] = Standing([&](std::size_t, Role role) {
    const auto parent = ParentOf(role);
    const double rho = parent && BoneKindOf(role) == BoneKind::kShank ? 0.6 : 0;
    unit[Index(role)] =
        (parent ? rho * unit[Index(*parent)] : glm::dvec3(0)) + std::sqrt(1 - rho * rho) * dice.stream.Normal3();
    return 0.01 * unit[Index(role)];
  });
  const SensorStatistics s = StatisticsOf(recording, &match);
  EXPECT_NEAR(*s.correlation[Index(BoneKind::kShank)], 0.6, 0.03);
  EXPECT_NEAR(*s.correlation[Index(BoneKind::kForearm)], 0, 0.03);
}

TEST(SensorStatistics, SeeWhiteNoiseOfAQuietTorsoAndNotItsSlowSway) {
  Dice dice;
  const auto white = [&](double sway_m) {
    const auto [recording, match] = Standing([&](std::size_t t, Role) {
      const double slow = sway_m * std::sin(0.02 * static_cast<double>(t));
      return glm::dvec3(slow, 0, 0) + 0.0002 * dice.stream.Normal3();
    });
    return *StatisticsOf(recording, nullptr).quiet_white_mm;
  };
  EXPECT_NEAR(white(0), 0.2, 0.01);
  EXPECT_NEAR(white(0.01), 0.2, 0.01);
}

TEST(SensorStatistics, MeasureLengthsInPercentAndJumpsInCentimetres) {
  const BodyPose pose = LoadBuiltinMove("sway")->motion.poses.front();
  // The left hand moves along its bone by a tenth of the bone's length; once in forty frames the right hand jumps.
  const glm::dvec3 bone = pose[kLeftHand] - pose[kLeftWrist];
  const auto [recording, match] = Standing([&](std::size_t t, Role role) {
    if (role == kLeftHand) return (t % 2 == 0 ? 0.1 : -0.1) * bone;
    if (role == kRightHand && t % 40 == 20) return glm::dvec3(0.3, 0, 0);
    return glm::dvec3(0);
  });
  const SensorStatistics s = StatisticsOf(recording, nullptr);
  const double right_mean = glm::distance(pose[kRightHand], pose[kRightWrist]);
  const double right_far = glm::length(pose[kRightHand] + glm::dvec3(0.3, 0, 0) - pose[kRightWrist]);
  const double share = 1 / 40.0, mean = right_mean + share * (right_far - right_mean);
  const double right = 100 * std::sqrt(share * (1 - share)) * (right_far - right_mean) / mean;
  EXPECT_NEAR(*s.hand_bones_percent, 0.5 * (10 + right), 0.05);
  EXPECT_NEAR(*s.hand_jump_cm, 60, 1e-6);  // a spike's second difference is twice its height
  EXPECT_NEAR(*s.arm_bones_percent, 0, 1e-9);
  EXPECT_NEAR(*s.shoulder_width_percent, 0, 1e-9);
}

TEST(SensorStatistics, LeaveOutWhatARecordingCannotTell) {
  const auto [recording, match] = Standing([](std::size_t, Role) { return glm::dvec3(0); });
  JointRecording headless = recording;
  for (RolePositions& places : headless.frames) places[Index(kLeftHand)] = places[Index(kRightHand)] = std::nullopt;
  const SensorStatistics s = StatisticsOf(headless, nullptr);
  EXPECT_FALSE(s.error_mm[0] || s.hand_bones_percent || s.hand_jump_cm);
  EXPECT_TRUE(s.arm_bones_percent);
  EXPECT_FALSE(StatisticsOf({}, nullptr).quiet_white_mm);
}

TEST(SensorStatistics, SummariseManyRecordingsByMeanAndDeviation) {
  SensorStatistics a, b;
  a.hand_jump_cm = 10;
  b.hand_jump_cm = 14;
  a.correlation[0] = 0.5;
  const SensorStatisticsSummary summary = Summarise({a, b});
  EXPECT_EQ(*summary.mean.hand_jump_cm, 12);
  EXPECT_NEAR(*summary.deviation.hand_jump_cm, std::sqrt(8.0), 1e-12);
  EXPECT_EQ(*summary.mean.correlation[0], 0.5);
  EXPECT_FALSE(summary.deviation.correlation[0]);
  EXPECT_FALSE(summary.mean.planted_feet_mm);
}

TEST(StatisticsTable, CountsAndMarksWhatLiesOutOfTolerance) {
  SensorStatistics real, near, far;
  real.hand_jump_cm = near.hand_jump_cm = far.hand_jump_cm = 10;
  real.planted_feet_mm = 3;
  near.planted_feet_mm = 3.8;  // 27 % more
  far.planted_feet_mm = 4.0;   // 33 %
  real.correlation[0] = 0.1;
  near.correlation[0] = 0.24;
  far.correlation[0] = 0.26;
  near.leg_bones_percent = 5;  // only one side has it, so it is not compared
  EXPECT_EQ(AgreementOf(real, near).compared, 3);
  EXPECT_EQ(AgreementOf(real, near).within, 3);
  EXPECT_EQ(AgreementOf(real, far).within, 1);
  const std::string table = StatisticsTable({{"real", real}, {"far", far}}, true);
  EXPECT_NE(table.find("x1.33 !"), std::string::npos) << table;
  EXPECT_NE(table.find("+0.16 !"), std::string::npos) << table;
  EXPECT_EQ(StatisticsTable({{"real", real}, {"near", near}}, true).find('!'), std::string::npos);
}

}  // namespace
}  // namespace etude
