#include "engine/transitions/joins/limbs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr glm::dvec3 kLeft(1, 0, 0), kUp(0, 1, 0), kFront(0, 0, 1);

TEST(LimbTurn, IsTheAxisTimesTheAngle) {
  const LimbTurn turn = TurnBetween(2.0 * kLeft, 5.0 * kUp);
  EXPECT_NEAR(glm::distance(turn, 0.5 * kPi * kFront), 0, 1e-12);
  EXPECT_NEAR(glm::distance(Turned(3.0 * kLeft, turn), 3.0 * kUp), 0, 1e-12);
}

TEST(LimbTurn, GoesHalfWayRoundBetweenOpposites) {
  for (const glm::dvec3& limb : {kLeft, kUp, kFront, -kUp, glm::dvec3(1, 1, 1)}) {
    const LimbTurn turn = TurnBetween(limb, -limb);
    EXPECT_NEAR(glm::length(turn), kPi, 1e-12);
    EXPECT_NEAR(glm::distance(Turned(limb, turn), -limb), 0, 1e-12);
  }
}

TEST(LimbTurn, IsNoneForALimbWithoutLength) {
  EXPECT_EQ(TurnBetween(glm::dvec3(0), kUp), LimbTurn(0));
  EXPECT_EQ(TurnBetween(kUp, glm::dvec3(0)), LimbTurn(0));
  EXPECT_EQ(Turned(kUp, LimbTurn(0)), kUp);
}

TEST(Turned, EqualsAQuaternionAtAnyAngle) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1, -2, 3)), limb(0.3, 0.1, -0.2);
  for (double angle : {1e-9, 1e-3, 0.2, 0.244, 0.246, 0.7, 0.999, 1.001, 2.0, kPi, 5.0}) {
    const glm::dvec3 turned = Turned(limb, angle * axis);
    EXPECT_NEAR(glm::distance(turned, glm::angleAxis(angle, axis) * limb), 0, 1e-15) << angle;
    EXPECT_NEAR(glm::length(turned), glm::length(limb), 1e-15) << angle;
  }
}

TEST(TurnOnFloor, IsTheAngleAboutTheVerticalWithItsSign) {
  EXPECT_NEAR(TurnOnFloor({0, 5, 2}, {3, -1, 0}), kPi / 2, 1e-15) << "from +Z to +X, whatever the heights";
  EXPECT_NEAR(TurnOnFloor({3, 0, 0}, {0, 0, 2}), -kPi / 2, 1e-15);
  EXPECT_NEAR(std::abs(TurnOnFloor({1, 0, 1}, {-2, 0, -2})), kPi, 1e-15);
  EXPECT_EQ(TurnOnFloor({0, 1, 0}, {1, 0, 0}), 0) << "a vertical direction has no heading";
}

TEST(TurnMeter, FindsTheLargestTurnWithinARun) {
  TurnMeter meter;
  EXPECT_EQ(meter.largest(), 0);
  for (const double turn : {0.5, 0.25, -1.0, 0.25}) meter.Add(turn);
  EXPECT_EQ(meter.largest(), 1) << "from 0.75 back to -0.25";
  meter.End();
  meter.Add(0.875);
  EXPECT_EQ(meter.largest(), 1) << "a new run starts at 0";
  meter.Add(0.25);
  EXPECT_EQ(meter.largest(), 1.125);
}

}  // namespace
}  // namespace etude
