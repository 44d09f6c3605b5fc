#include "engine/motion/body.h"

#include <gtest/gtest.h>

#include "engine/base/directions.h"

namespace etude {
namespace {

using enum Role;

TEST(Body, HasParentsBeforeChildrenAndOneRoot) {
  int roots = 0;
  for (Role role : AllRoles()) {
    const auto parent = ParentOf(role);
    if (!parent) ++roots;
    if (parent) {
      EXPECT_LT(Index(*parent), Index(role)) << RoleName(role);
    }
  }
  EXPECT_EQ(roots, 1);
}

TEST(Body, FindsEveryRoleByItsNameAndMirrorsItBack) {
  for (Role role : AllRoles()) {
    EXPECT_EQ(FindRole(RoleName(role)), role);
    EXPECT_EQ(Mirrored(Mirrored(role)), role);
    if (const auto parent = ParentOf(role)) {
      EXPECT_EQ(ParentOf(Mirrored(role)), Mirrored(*parent)) << RoleName(role);
    }
  }
  EXPECT_EQ(FindRole("tail"), std::nullopt);
}

TEST(Body, FacesWhereItIsTurnedAndComesBackToTheOrigin) {
  BodyPose rest;
  rest[kLeftHip] = {0.09, 0.9, 0};
  rest[kRightHip] = {-0.09, 0.9, 0};
  rest[kLeftShoulder] = {0.18, 1.4, 0};
  rest[kRightShoulder] = {-0.18, 1.4, 0};
  rest[kHipCentre] = {0, 0.9, 0};
  rest[kLeftFoot] = {0.09, 0, 0.18};
  EXPECT_NEAR(Heading(rest), 0, 1e-15);
  for (const double yaw : {-3.0, -1.0, 0.5, 2.0}) {
    const FloorMove move{.yaw = yaw, .x = 1.5, .z = -4};
    const BodyPose moved = move.Apply(rest);
    EXPECT_NEAR(Heading(moved), yaw, 1e-12);
    EXPECT_NEAR(AngleBetween(Facing(moved), {std::sin(yaw), 0, std::cos(yaw)}), 0, 1e-12);
    const BodyPose back = ToOrigin(moved).Apply(moved);
    for (Role role : AllRoles()) {
      // Joints at the origin of the rest pose move with it, so all twenty must come back.
      EXPECT_LT(glm::distance(back[role], rest[role]), 1e-12) << RoleName(role);
    }
  }
}

TEST(Body, FacesForwardWhereNothingTellsWhere) {
  // First all joints are at one point; then a body lies on its side, so the lines through its hips and through its
  // shoulders are vertical.
  EXPECT_EQ(Facing(BodyPose()), glm::dvec3(0, 0, 1));
  BodyPose lying;
  lying[kLeftHip] = lying[kLeftShoulder] = {0, 0.5, 0};
  EXPECT_EQ(Facing(lying), glm::dvec3(0, 0, 1));
  EXPECT_EQ(Heading(lying), 0);
}

}  // namespace
}  // namespace etude
