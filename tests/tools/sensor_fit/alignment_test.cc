#include "tools/sensor_fit/alignment.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/results.h"
#include "tests/tools/sensor_fit/small_recording.h"

namespace etude {
namespace {

TEST(AlignTwin, FindsShiftRotationAndOffsetsOfAPerfectRecording) {
  const TwinMotion twin = DancingTwin(9);
  const MadeUp made;
  ASSERT_OK(match, AlignTwin(PerfectRecording(twin, 7, made), twin));
  EXPECT_NEAR(match->alignment.shift_s, made.shift_s, 1e-6);
  EXPECT_LT(match->alignment.rms_m, 1e-4);
  const glm::dmat3 expected = glm::mat3_cast(made.rotation);
  for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(match->alignment.R_ST[c] - expected[c]), 2e-3);
  // The returned truth is the recording itself.
  const JointRecording recording = PerfectRecording(twin, 7, made);
  double worst = 0;
  for (std::size_t t = 0; t < recording.frames.size(); ++t) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      worst = std::max(worst, glm::distance(*recording.frames[t][j], *match->truth[t][j]));
    }
  }
  EXPECT_LT(worst, 1e-3);
}

TEST(AlignTwin, OfAMotionThatRepeatsTakesTheShiftAtWhichTheWholeTakeOverlaps) {
  // The motion comes twice. A shift by its length leaves the noisy beginning out, and half of the recording with it.
  const std::vector<std::string> moves = {"boxing", "side_kick"};
  const BodyMotion once = AfterEachOther(moves);
  const double seconds = static_cast<double>(once.poses.size() - 1) / once.rate_hz;
  const TwinMotion twin = DancingTwin(2 * seconds, 1, moves);
  JointRecording recording = PerfectRecording(twin, 2 * seconds - 0.1, {.shift_s = 0});
  RandomStream dice({.suite_seed = 1, .scenario = "repeats", .trial = 0}, "noise");
  for (std::size_t t = 0; t < recording.frames.size() / 4; ++t) {
    for (auto& place : recording.frames[t]) *place += 0.02 * dice.Normal3();
  }
  ASSERT_OK(match, AlignTwin(recording, twin));
  EXPECT_NEAR(match->alignment.shift_s, 0, 0.02);
}

TEST(AlignTwin, OfAlikeMovesTakesTheShiftThatFitsEvenIfLessOverlaps) {
  // One move comes again and again, each time a little smaller or larger. The recording begins in the middle.
  const std::vector<std::string> moves = {"boxing"};
  const BodyMotion once = AfterEachOther(moves);
  const double seconds = static_cast<double>(once.poses.size() - 1) / once.rate_hz;
  TwinMotion twin = DancingTwin(12 * seconds, 1, moves);
  std::array<glm::dvec3, kRoleCount> first{};
  for (std::size_t j = 0; j < kRoleCount; ++j) first[j] = twin.frames[0][j]->position;
  for (std::size_t f = 0; f < twin.frames.size(); ++f) {
    const double repeat = std::floor(static_cast<double>(f) / twin.rate_hz / seconds);
    const double size = 1 + 0.15 * std::sin(5 * repeat);
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      twin.frames[f][j]->position = glm::mix(first[j], twin.frames[f][j]->position, size);
    }
  }
  const double begin_s = 5 * seconds;
  JointRecording recording = PerfectRecording(twin, 7 * seconds - 0.1, {.shift_s = begin_s});
  TwinMotion early = twin;
  early.frames.resize(static_cast<std::size_t>(9.5 * seconds * twin.rate_hz));
  ASSERT_OK(match, AlignTwin(recording, early));
  EXPECT_NEAR(match->alignment.shift_s, begin_s, 0.02);
  EXPECT_LT(match->alignment.rms_m, 1e-3);
}

TEST(AlignTwin, LeavesWhatTheSensorErrs) {
  const TwinMotion twin = DancingTwin(9);
  JointRecording recording = PerfectRecording(twin, 7, {});
  RandomStream dice({.suite_seed = 1, .scenario = "align", .trial = 0}, "noise");
  double squares = 0, count = 0;
  for (RolePositions& places : recording.frames) {
    for (auto& place : places) {
      const glm::dvec3 error = 0.02 * dice.Normal3();
      *place += error;
      squares += glm::dot(error, error);
      ++count;
    }
  }
  ASSERT_OK(match, AlignTwin(recording, twin));
  EXPECT_NEAR(match->alignment.rms_m, std::sqrt(squares / count), 0.0005);
}

TEST(AlignTwin, TakesJointsThatAreMissingNowAndThenOrAlways) {
  const TwinMotion twin = DancingTwin(9);
  JointRecording recording = PerfectRecording(twin, 7, {});
  for (std::size_t t = 0; t < recording.frames.size(); ++t) {
    recording.frames[t][Index(Role::kHead)].reset();
    if (t % 3 == 0) recording.frames[t][Index(Role::kLeftHand)].reset();
    if (t > 50 && t < 70) recording.frames[t] = {};
  }
  ASSERT_OK(match, AlignTwin(recording, twin));
  EXPECT_LT(match->alignment.rms_m, 1e-4);
  EXPECT_FALSE(match->alignment.offsets[Index(Role::kHead)]);
  EXPECT_FALSE(match->truth[10][Index(Role::kHead)]);
}

TEST(AlignTwin, SaysNothingOfRecordingsThatShareTooLittle) {
  const TwinMotion twin = DancingTwin(9);
  JointRecording few = PerfectRecording(twin, 7, {});
  for (RolePositions& places : few.frames) {
    for (std::size_t j = 2; j < kRoleCount; ++j) places[j].reset();
  }
  EXPECT_FALSE(AlignTwin(few, twin));
  EXPECT_FALSE(AlignTwin(Excerpt(PerfectRecording(twin, 7, {}), 0, 20), twin));
  EXPECT_FALSE(AlignTwin({}, twin));
  EXPECT_FALSE(AlignTwin(PerfectRecording(twin, 7, {}), {}));
}

}  // namespace
}  // namespace etude
