#include "sim/body/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "sim/choreography/canonical_body.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

using enum Role;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Capsule kUpright = {Part::kTrunk, {0, 0, 0}, {0, 2, 0}, 0.5};

TEST(HitDistance, MeetsTheSideTheCapAndTheTipWhereGeometrySays) {
  EXPECT_DOUBLE_EQ(HitDistance(kUpright, {3, 1, 0}, {-1, 0, 0}), 2.5);
  EXPECT_DOUBLE_EQ(HitDistance(kUpright, {0, 5, 0}, {0, -1, 0}), 2.5) << "along the axis, onto the half-sphere";
  EXPECT_DOUBLE_EQ(HitDistance(kUpright, {3, 2.3, 0}, {-1, 0, 0}), 3 - 0.4) << "0.3 up a sphere of 0.5: 0.4 wide";
  EXPECT_DOUBLE_EQ(HitDistance(kUpright, {3, 1, 0.3}, {-1, 0, 0}), 3 - 0.4);
}

TEST(HitDistance, IsInfiniteBesideAndBehindAndZeroInside) {
  EXPECT_EQ(HitDistance(kUpright, {3, 1, 0.51}, {-1, 0, 0}), kInfinity);
  EXPECT_EQ(HitDistance(kUpright, {3, 1, 0}, {1, 0, 0}), kInfinity);
  EXPECT_EQ(HitDistance(kUpright, {3, 2.51, 0}, {-1, 0, 0}), kInfinity);
  EXPECT_EQ(HitDistance(kUpright, {0.2, 1, 0}, {1, 0, 0}), 0);
}

TEST(HitDistance, TakesACapsuleOfNoLengthForASphere) {
  const Capsule ball = {Part::kHead, {0, 1, 0}, {0, 1, 0}, 0.25};
  EXPECT_DOUBLE_EQ(HitDistance(ball, {0, 1, 4}, {0, 0, -1}), 3.75);
}

double DistanceToSurface(const Capsule& capsule, const glm::dvec3& point) {
  const glm::dvec3 axis = capsule.b - capsule.a;
  const double along = glm::clamp(glm::dot(point - capsule.a, axis) / glm::dot(axis, axis), 0.0, 1.0);
  return glm::distance(point, capsule.a + along * axis) - capsule.radius;
}

/// A second implementation: walks along the ray by the distance to the surface until it reaches the surface.
double MarchedDistance(const Capsule& capsule, const glm::dvec3& origin, const glm::dvec3& direction) {
  double t = 0;
  for (int step = 0; step < 20000 && t < 20; ++step) {
    const double free = DistanceToSurface(capsule, origin + t * direction);
    if (free < 1e-9) return t;
    t += free;
  }
  return kInfinity;
}

TEST(HitDistance, AgreesWithSphereMarching) {
  RandomStream random({}, "rays");
  int hits = 0, misses = 0;
  for (int i = 0; i < 3000; ++i) {
    const Capsule capsule = {Part::kTrunk, random.Normal3(), random.Normal3(), random.Uniform(0.05, 0.8)};
    const glm::dvec3 origin = 3.0 * random.Normal3();
    const glm::dvec3 aim = glm::mix(capsule.a, capsule.b, random.Uniform()) + 0.6 * random.Normal3();
    const glm::dvec3 direction = glm::normalize(aim - origin);
    const double exact = HitDistance(capsule, origin, direction), marched = MarchedDistance(capsule, origin, direction);
    if (std::isinf(exact)) {
      // For a grazing ray either answer is right, within the marcher's precision.
      if (!std::isinf(marched)) {
        EXPECT_NEAR(DistanceToSurface(capsule, origin + marched * direction), 0, 1e-8);
      }
      ++misses;
    } else {
      EXPECT_NEAR(exact, marched, 1e-4) << "ray " << i;
      EXPECT_NEAR(std::max(0.0, DistanceToSurface(capsule, origin + exact * direction)), 0, 1e-9);
      ++hits;
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
}

TEST(BodyCapsules, CoverEveryJointAndEveryPart) {
  const BodyPose pose = StandingPose();
  const std::vector<Capsule> body = BodyCapsules(pose);
  for (Role role : AllRoles()) {
    const bool covered = std::ranges::any_of(body, [&](const Capsule& capsule) {
      const Capsule whole = {capsule.part, capsule.a, capsule.b + glm::dvec3(0, 1e-9, 0), capsule.radius};
      return DistanceToSurface(whole, pose[role]) < 0;
    });
    EXPECT_TRUE(covered) << RoleName(role);
  }
  for (auto part = kFirstBodyPart; part <= static_cast<std::uint32_t>(Part::kRightFoot); ++part) {
    EXPECT_TRUE(std::ranges::any_of(body, [&](const Capsule& c) { return c.part == static_cast<Part>(part); })) << part;
  }
}

TEST(BodyCapsules, GrowWithTheBody) {
  BodyPose giant = StandingPose();
  for (glm::dvec3& joint : giant.joints) joint *= 2.0;
  const auto small = BodyCapsules(StandingPose()), large = BodyCapsules(giant);
  ASSERT_EQ(small.size(), large.size());
  for (std::size_t i = 0; i < small.size(); ++i) EXPECT_NEAR(large[i].radius, 2 * small[i].radius, 1e-12);
}

TEST(BodyCapsules, StandOnTheFloorAndReachTheStature) {
  double lowest = kInfinity, highest = 0;
  for (const Capsule& capsule : BodyCapsules(StandingPose())) {
    lowest = std::min({lowest, capsule.a.y - capsule.radius, capsule.b.y - capsule.radius});
    highest = std::max({highest, capsule.a.y + capsule.radius, capsule.b.y + capsule.radius});
  }
  EXPECT_NEAR(lowest, 0, 0.01);
  EXPECT_NEAR(highest, 1.70, 0.03);
}

TEST(BodyCapsules, StayFiniteForACollapsedPose) {
  for (const Capsule& capsule : BodyCapsules(BodyPose{})) {
    EXPECT_TRUE(std::isfinite(glm::length(capsule.a) + glm::length(capsule.b) + capsule.radius));
  }
}

TEST(IsHidden, NothingIsHiddenOfABodySeenFromTheFront) {
  const BodyPose pose = StandingPose();
  for (Role role : AllRoles()) EXPECT_FALSE(IsHidden(pose, role, {0, 1.2, 3})) << RoleName(role);
}

TEST(IsHidden, TheFarArmIsHiddenBehindTheTrunkInProfile) {
  const BodyPose pose = StandingPose();
  const glm::dvec3 from_left(4, 1.2, 0);
  EXPECT_TRUE(IsHidden(pose, kRightElbow, from_left));
  EXPECT_TRUE(IsHidden(pose, kRightKnee, from_left));
  EXPECT_FALSE(IsHidden(pose, kLeftElbow, from_left));
  EXPECT_FALSE(IsHidden(pose, kLeftKnee, from_left));
  EXPECT_FALSE(IsHidden(pose, kHead, from_left));
}

TEST(IsHidden, AHandBehindTheBackIsHiddenUntilOneLooksFromBehind) {
  BodyPose pose = StandingPose();
  pose[kLeftHand] = {0, 1.1, -0.25};
  pose[kLeftWrist] = {0.12, 1.1, -0.22};
  EXPECT_TRUE(IsHidden(pose, kLeftHand, {0, 1.2, 3}));
  EXPECT_FALSE(IsHidden(pose, kLeftHand, {0, 1.2, -3}));
}

TEST(IsHidden, AFlatHandOnTheChestHidesNothingButTheChest) {
  BodyPose pose = StandingPose();
  pose[kLeftHand] = pose[kSpine] + glm::dvec3(0, 0, 0.3);
  pose[kLeftWrist] = pose[kLeftHand] + glm::dvec3(0.1, 0, 0);
  EXPECT_TRUE(IsHidden(pose, kSpine, {pose[kSpine].x, pose[kSpine].y, 3}));
  EXPECT_FALSE(IsHidden(pose, kLeftHand, {pose[kSpine].x, pose[kSpine].y, 3}));
  EXPECT_FALSE(IsHidden(pose, kHead, {0, 1.2, 3}));
}

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
  const Cuboid long_box{{0, 0, 0}, {0.1, 1, 2}, Radians(90)};  // its long side now lies along +X
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

/// A second implementation: takes small steps until the point lies inside.
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
    } else if (hit < 11) {  // grazes an edge: the ray is in the box for less than a step
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
