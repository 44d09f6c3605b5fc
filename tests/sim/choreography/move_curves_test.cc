#include "sim/choreography/move_curves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/choreography/canonical_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr double kBeats = 4, kBeatSeconds = 0.5;

PeriodicCurve CurveOf(const std::vector<PoseKey>& poses, std::size_t control) {
  return {KeysOf(poses, control, kBeats, kBeatSeconds), kBeats};
}

PoseKey At(double beat) { return {.beat = beat, .controls = ReadyStance()}; }

PoseKey JumpAt(double beat, double height) {
  PoseKey pose = At(beat);
  pose.controls[MiddleControl::kJump] = height;
  return pose;
}

TEST(KeysOf, AFootThatChangesItsSpotIsInTheAirWhileItTravels) {
  std::vector<PoseKey> poses = {At(0), At(1), At(2.5)};
  poses[1].controls.Of(Side::kLeft, SideControl::kFootSide) = 0.2;
  const auto left = [&](SideControl control) { return CurveOf(poses, Controls::SideIndex(Side::kLeft, control)); };
  const PeriodicCurve side = left(SideControl::kFootSide), lift = left(SideControl::kFootLift);
  int travelling = 0;
  for (double beat = 0; beat < kBeats; beat += 0.01) {
    if (std::abs(side.At(beat) - side.At(beat + 0.01)) < 1e-9) continue;
    ++travelling;
    EXPECT_GT(lift.At(beat), 0.001) << beat;
    EXPECT_GT(lift.At(beat + 0.01), 0.001) << beat;
  }
  EXPECT_GT(travelling, 100);
  for (double beat : {0.0, 1.0, 2.5, 3.3}) EXPECT_NEAR(lift.At(beat), 0, 1e-12) << "on the floor in every pose";

  const PeriodicCurve other = CurveOf(poses, Controls::SideIndex(Side::kRight, SideControl::kFootLift));
  for (double beat = 0; beat < kBeats; beat += 0.1) EXPECT_EQ(other.At(beat), 0) << "the other foot stands";
}

TEST(KeysOf, AStepMayCrossTheSeamOfTheLoop) {
  std::vector<PoseKey> poses = {At(0.2), At(3)};
  poses[1].controls.Of(Side::kRight, SideControl::kFootAhead) = 0.1;
  const PeriodicCurve lift = CurveOf(poses, Controls::SideIndex(Side::kRight, SideControl::kFootLift));
  EXPECT_GT(lift.At(3.6), 0.04);
  EXPECT_GT(lift.At(1.6), 0.04);
}

TEST(KeysOf, AJumpIsAParabolaWhateverThePosesInTheAirSay) {
  constexpr double kHeight = 0.2, kGravity = 9.80665;
  const std::vector<PoseKey> poses = {At(0), At(1.7), JumpAt(2, kHeight), At(2.3), At(3)};
  const PeriodicCurve jump = CurveOf(poses, static_cast<std::size_t>(MiddleControl::kJump));
  const double half_s = std::sqrt(2 * kHeight / kGravity);
  for (double t = -half_s; t <= half_s; t += 0.01) {
    EXPECT_NEAR(jump.At(2 + t / kBeatSeconds), kHeight - 0.5 * kGravity * t * t, 1e-12);
  }
  EXPECT_LT(jump.At(2 - half_s / kBeatSeconds - 0.1), -0.01) << "the knees throw the body up";
  EXPECT_LT(jump.At(2 + half_s / kBeatSeconds + 0.1), -0.01) << "and catch it";
  EXPECT_EQ(jump.At(0), 0);
  EXPECT_EQ(jump.At(3.5), 0);
}

TEST(CheckJumps, RefusesAJumpThatHasNoTime) {
  const auto complaint = [](const std::vector<PoseKey>& poses) {
    return testing::Message(CheckJumps(poses, kBeats, kBeatSeconds, {}));
  };
  EXPECT_EQ(complaint({At(0), JumpAt(1.1, 0.05), JumpAt(2.6, 0.1)}), "accepted");
  EXPECT_THAT(complaint({JumpAt(0, 0.1)}), ::testing::HasSubstr("beat 0 would last"));
  EXPECT_THAT(complaint({At(0), JumpAt(1.1, 0.02), JumpAt(1.6, 0.1)}), ::testing::HasSubstr("beat 1.6 would last"));
  EXPECT_THAT(complaint({At(0), JumpAt(3.8, 0.2)}), ::testing::HasSubstr("allowed: a jump between beats 0.00 and 4"));
}

}  // namespace

}  // namespace etude
