#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "engine/retargeting/joint_map.h"
#include "tests/support/person.h"

namespace etude::testing {

inline BodyPose BodyAtRest(const Skeleton& skeleton, const JointMap& map) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(skeleton, RestPose(skeleton), globals);
  return Evaluate(map, globals);
}

inline void ExpectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12) {
  EXPECT_LT(glm::distance(actual, expected), tolerance)
      << "(" << actual.x << ", " << actual.y << ", " << actual.z << ")";
}

/// Checks that the twenty roles are at their positions in PersonSkeleton at rest, with `scale` units per centimetre.
inline void ExpectThePersonsPlaces(const BodyPose& body, double scale = 1, double tolerance = 1e-12) {
  using enum Role;
  const auto expect = [&](Role role, const glm::dvec3& place) {
    SCOPED_TRACE(RoleName(role));
    ExpectNear(body[role], scale * place, tolerance);
  };
  expect(kHipCentre, {0, 90, 0});
  expect(kSpine, {0, 115, 0});
  expect(kShoulderCentre, {0, 140, 0});
  expect(kHead, {0, 165, 0});
  expect(kLeftShoulder, {18, 137, 0});
  expect(kLeftElbow, {47, 137, 0});
  expect(kLeftWrist, {72, 137, 0});
  expect(kLeftHand, {90, 137, 0});
  expect(kLeftHip, {9, 90, 0});
  expect(kLeftKnee, {9, 47, 0});
  expect(kLeftAnkle, {9, 5, 0});
  expect(kLeftFoot, {9, 0, 18});
  for (Role role : AllRoles()) {
    const glm::dvec3& other = body[Mirrored(role)];
    ExpectNear(body[role], {-other.x, other.y, other.z}, tolerance);
  }
}

/// Checks that FindJointMap finds all roles in a skeleton that equals PersonSkeleton apart from the joints' names.
inline void ExpectThePerson(const Skeleton& skeleton) {
  const auto map = FindJointMap(skeleton, "person.bvh");
  ASSERT_TRUE(map) << ToString(map.error());
  EXPECT_THAT(map->composed, ::testing::IsEmpty());
  ExpectThePersonsPlaces(BodyAtRest(skeleton, *map));
}

}  // namespace etude::testing
