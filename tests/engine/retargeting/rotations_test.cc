#include "engine/retargeting/rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

const glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

void ExpectSameVector(const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::distance(a, b), 1e-12); }

TEST(ShortestTurn, TurnsAboutTheNormalOfBoth) {
  const glm::dquat turn = ShortestTurn(2.0 * kX, 3.0 * kY);
  ExpectSameVector(turn * kX, kY);
  ExpectSameVector(turn * kZ, kZ);
}

TEST(ShortestTurn, IsAlsoExactForNearlyEqualAndNearlyOppositeDirections) {
  for (const double angle : {1e-12, 1e-6, kPi - 1e-6, kPi}) {
    const glm::dvec3 to(std::cos(angle), std::sin(angle), 0);
    ExpectSameVector(ShortestTurn(kX, to) * kX, to);
  }
}

TEST(ShortestTurn, OfNoDirectionIsNone) {
  EXPECT_EQ(ShortestTurn(glm::dvec3(0), kX), glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(ShortestTurn(kX, glm::dvec3(0)), glm::dquat(1, 0, 0, 0));
}

TEST(Orientation, KeepsTheFirstAxisAndThePlane) {
  const glm::dquat axes = Orientation(3.0 * kZ, kX + 5.0 * kZ);
  ExpectSameVector(axes * kX, kZ);
  ExpectSameVector(axes * kY, kX);
}

TEST(Orientation, OfParallelAxesIsAnyThatKeepsTheFirst) {
  ExpectSameVector(Orientation(kY, 2.0 * kY) * kX, kY);
  ExpectSameVector(Orientation(kY, glm::dvec3(0)) * kX, kY);
}

}  // namespace
}  // namespace etude
