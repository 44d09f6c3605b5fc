#include "engine/motion/character.h"

#include <gtest/gtest.h>

#include <numbers>

namespace etude {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

void ExpectNear(const glm::dvec3& found, const glm::dvec3& expected) {
  EXPECT_LT(glm::length(found - expected), 1e-12) << "(" << found.x << ", " << found.y << ", " << found.z << ")";
}

/// An arm along X: its upper half on joint 0 at the origin, its lower half on joint 1 at (1, 0, 0).
struct Arm {
  Skeleton skeleton;
  LocalPose pose;
  SkinnedMesh mesh;

  Arm() {
    skeleton.joints = {{.name = "upper", .parent = -1, .rest = {}},
                       {.name = "lower", .parent = 0, .rest = {.translation = {1, 0, 0}}}};
    pose = RestPose(skeleton);
    mesh.bindings.resize(2);
    mesh.bindings[1].joint = 1;
    mesh.bindings[1].inverse_bind[3] = {-1, 0, 0, 1};
  }

  void Add(const glm::dvec3& position, const glm::dvec3& normal, double upper, double lower) {
    mesh.vertices.push_back(
        {.position = position, .normal = normal, .bindings = {0, 1, 0, 0}, .weights = {upper, lower, 0, 0}});
  }

  DeformedMesh Deformed() const {
    std::vector<GlobalTransform> globals;
    ComputeGlobals(skeleton, pose, globals);
    return Deform(mesh, globals);
  }
};

TEST(Deform, LeavesAMeshAsItWasBoundInTheBindingPose) {
  Arm arm;
  arm.Add({0.5, 0.1, 0.2}, {0, 1, 0}, 1, 0);
  arm.Add({1.0, 0.1, 0.2}, {0, 0, 1}, 0.3, 0.7);
  arm.Add({1.7, 0.1, 0.2}, {1, 0, 0}, 0, 1);
  const DeformedMesh deformed = arm.Deformed();
  ASSERT_EQ(deformed.positions.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    ExpectNear(deformed.positions[i], arm.mesh.vertices[i].position);
    ExpectNear(deformed.normals[i], arm.mesh.vertices[i].normal);
  }
}

TEST(Deform, MovesARigidMeshWithItsJoint) {
  Arm arm;
  arm.Add({1.5, 0, 0}, {0, 1, 0}, 0, 1);
  arm.pose[0].translation = {0, 2, 0};
  arm.pose[1].rotation = glm::angleAxis(kRightAngle, glm::dvec3(0, 0, 1));  // the elbow turns the forearm up
  const DeformedMesh deformed = arm.Deformed();
  ExpectNear(deformed.positions[0], {1, 2.5, 0});
  ExpectNear(deformed.normals[0], {-1, 0, 0});
}

TEST(Deform, BlendsTheTwoPlacesOfAVertexHalfWay) {
  Arm arm;
  arm.Add({1.5, 0, 0}, {0, 1, 0}, 0.5, 0.5);
  arm.pose[1].rotation = glm::angleAxis(kRightAngle, glm::dvec3(0, 0, 1));
  const DeformedMesh deformed = arm.Deformed();
  // Linear blending gives the middle of (1.5, 0, 0) and (1, 0.5, 0), inside the true arc.
  ExpectNear(deformed.positions[0], {1.25, 0.25, 0});
  ExpectNear(deformed.normals[0], glm::normalize(glm::dvec3(-1, 1, 0)));
}

TEST(Deform, KeepsNormalsUprightOnAStretchedSurface) {
  Arm arm;
  // A slope along (1, −1, 0), hence its normal.
  arm.Add({0, 0, 0}, glm::normalize(glm::dvec3(1, 1, 0)), 1, 0);
  arm.Add({0, 0, 0}, glm::normalize(glm::dvec3(1, 1, 0)), 0.5, 0.5);  // the code for blended weights agrees
  arm.pose[0].scale = {3, 1, 1};
  arm.pose[1].translation = {1, 0, 0};
  const DeformedMesh deformed = arm.Deformed();
  for (const glm::dvec3& normal : deformed.normals) {
    ExpectNear(normal, glm::normalize(glm::dvec3(1, 3, 0)));
    EXPECT_NEAR(glm::dot(normal, glm::dvec3(3, -1, 0)), 0, 1e-12);  // still normal to the stretched slope
  }
}

TEST(Deform, KeepsNormalsOutsideUnderAMirrorImage) {
  Arm arm;
  arm.Add({0.5, 0, 0}, {1, 0, 0}, 1, 0);
  arm.Add({0.5, 0, 0}, {0, 1, 0}, 0.4, 0.6);
  arm.pose[0].scale = {-1, 1, 1};
  const DeformedMesh deformed = arm.Deformed();
  ExpectNear(deformed.positions[0], {-0.5, 0, 0});
  ExpectNear(deformed.normals[0], {-1, 0, 0});
  ExpectNear(deformed.normals[1], {0, 1, 0});
}

TEST(Deform, GivesFiniteUnitNormalsOnAFlattenedJoint) {
  Arm arm;
  arm.Add({0.5, 0.5, 0}, {0, 1, 0}, 1, 0);
  arm.Add({0.5, 0.5, 0}, {1, 0, 0}, 1, 0);
  arm.pose[0].scale = {1, 0, 1};
  const DeformedMesh deformed = arm.Deformed();
  ExpectNear(deformed.positions[0], {0.5, 0, 0});
  ExpectNear(deformed.normals[0], {0, 1, 0});
  EXPECT_NEAR(glm::length(deformed.normals[1]), 1, 1e-12);
  arm.pose[0].scale = {0, 0, 0};
  EXPECT_NEAR(glm::length(arm.Deformed().normals[0]), 1, 1e-12);
}

}  // namespace
}  // namespace etude
