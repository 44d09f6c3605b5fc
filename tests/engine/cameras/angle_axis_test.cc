#include "engine/cameras/angle_axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "engine/base/angles.h"
#include "tests/support/random_clip.h"

namespace etude {
namespace {

double Distance(const glm::dmat3& a, const glm::dmat3& b) {
  double most = 0;
  for (int i = 0; i < 3; ++i) most = std::max(most, glm::length(a[i] - b[i]));
  return most;
}

/// Returns rotation vectors of lengths up to π; the smallest ones need the first-order branch.
std::vector<glm::dvec3> Turns() {
  testing::Dice dice(1);
  std::vector<glm::dvec3> turns = {{0, 0, 0}, {kPi, 0, 0}, {0, 0, -kPi}};
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 axis = glm::normalize(dice.Vector());
    turns.push_back(std::pow(10.0, -(i % 12)) * kPi * (0.1 + 0.8999 * (i % 7) / 6.0) * axis);
  }
  return turns;
}

// Second implementation: GLM's quaternions.
TEST(AngleAxis, TurnsByItsLengthAboutItsDirection) {
  for (const glm::dvec3& v : Turns()) {
    const double angle = glm::length(v);
    const glm::dmat3 R = angle > 0 ? glm::mat3_cast(glm::angleAxis(angle, v / angle)) : glm::dmat3(1);
    EXPECT_LT(Distance(FromAngleAxis(v), R), 2e-15);
    const glm::dvec3 p(0.3, -1.2, 2.5);
    const std::array<double, 3> turned = RotateByAngleAxis(&v.x, std::array<double, 3>{p.x, p.y, p.z});
    EXPECT_LT(glm::distance(glm::dvec3(turned[0], turned[1], turned[2]), R * p), 2e-15 * glm::length(p));
  }
}

TEST(AngleAxis, ComesBackFromItsRotation) {
  for (const glm::dvec3& v : Turns()) {
    const glm::dvec3 back = ToAngleAxis(FromAngleAxis(v));
    // At π, both directions of the axis give the same rotation.
    const double off = std::min(glm::distance(back, v), glm::length(v) > 3.14 ? glm::distance(-back, v) : 9.0);
    EXPECT_LT(off, 1e-14) << v.x << " " << v.y << " " << v.z;
    EXPECT_LE(glm::length(back), kPi + 1e-15);
  }
}

}  // namespace
}  // namespace etude
