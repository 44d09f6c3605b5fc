#include "sim/body/cuboid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

TEST(CuboidHitDistance, MeetsItsFacesWhereGeometrySays) {
  const Cuboid box{{0, 1, 0}, {1, 1, 0.5}, 0};
  EXPECT_DOUBLE_EQ(HitDistance(box, {0, 1, 5}, {0, 0, -1}), 4.5);
  EXPECT_DOUBLE_EQ(HitDistance(box, {5, 1, 0}, {-1, 0, 0}), 4);
  EXPECT_DOUBLE_EQ(HitDistance(box, {0, 7, 0}, {0, -1, 0}), 5);
  EXPECT_TRUE(std::isinf(HitDistance(box, {0, 1, 5}, {0, 0, 1}))) << "behind";
  EXPECT_TRUE(std::isinf(HitDistance(box, {1.01, 1, 5}, {0, 0, -1}))) << "beside, along two of its faces";
  EXPECT_EQ(HitDistance(box, {0.5, 1, 0.2}, {0, 0, 1}), 0) << "inside";
}

TEST(CuboidHitDistance, TurnsItsOwnZTowardsItsHeading) {
  const Cuboid long_box{{0, 0, 0}, {0.1, 1, 2}, Radians(90)};  // its long side lies along +X now
  EXPECT_NEAR(HitDistance(long_box, {5, 0, 0}, {-1, 0, 0}), 3, 1e-12);
  EXPECT_NEAR(HitDistance(long_box, {0, 0, 5}, {0, 0, -1}), 4.9, 1e-12);
  const Cuboid oblique{{0, 0, 0}, {0.1, 1, 2}, Radians(30)};
  const glm::dvec3 along(std::sin(Radians(30)), 0, std::cos(Radians(30)));
  EXPECT_NEAR(HitDistance(oblique, 5.0 * along, -along), 3, 1e-12);
}

bool IsInBox(const Cuboid& box, const glm::dvec3& point) {
  const glm::dvec3 x(std::cos(box.heading), 0, -std::sin(box.heading)),
      z(std::sin(box.heading), 0, std::cos(box.heading));
  const glm::dvec3 from = point - box.centre;
  return std::abs(glm::dot(from, x)) <= box.half_size.x && std::abs(from.y) <= box.half_size.y &&
         std::abs(glm::dot(from, z)) <= box.half_size.z;
}

/// The second implementation: small steps until the point lies inside.
TEST(CuboidHitDistance, AgreesWithSteppingAlongTheRay) {
  constexpr double kStep = 1e-3;
  RandomStream random({}, "rays");
  int hits = 0, misses = 0;
  for (int i = 0; i < 500; ++i) {
    const Cuboid box{random.Normal3(), glm::dvec3(0.2) + glm::abs(random.Normal3()), random.Uniform(-kPi, kPi)};
    const glm::dvec3 origin = 3.0 * random.Normal3();
    const glm::dvec3 direction = glm::normalize(random.Normal3() + 0.5 * (box.centre - origin));
    double stepped = 0;
    while (stepped < 12 && !IsInBox(box, origin + stepped * direction)) stepped += kStep;
    const double hit = HitDistance(box, origin, direction);
    if (stepped < 12) {
      EXPECT_NEAR(hit, stepped, 2 * kStep);
      ++hits;
    } else if (hit < 11) {  // no more than a grazed edge
      EXPECT_FALSE(IsInBox(box, origin + (hit + 5 * kStep) * direction));
    } else {
      ++misses;
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 100);
}

}  // namespace
}  // namespace etude
