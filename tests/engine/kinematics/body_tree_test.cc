#include "engine/kinematics/body_tree.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

using enum Role;

TEST(BodyTree, HasPaperBs29DegreesOfFreedomAndFourEffectors) {
  EXPECT_EQ(Body().dof_count(), 29);
  ASSERT_EQ(Body().effectors.size(), 4u);
  EXPECT_EQ(Body().effectors[0].name, "right_foot");
  EXPECT_EQ(Body().effectors[3].name, "head");
}

// A root has no offset from a parent: only the state places it.
TEST(BodyTree, StandsWhereItsStatePutsTheRoot) {
  EXPECT_EQ(Body().joints[0].parent, -1);
  EXPECT_EQ(Body().joints[0].p_PJ, glm::dvec3(0));
  TreeState state = StandingState(Body());
  state.root_position = {1, 2, 3};
  EXPECT_EQ(ComputeFrames(Body(), state).joints[0].position, glm::dvec3(1, 2, 3));
}

// In any pose, a limb's Z axis runs from its role to the next.
TEST(BodyTree, LimbsRunFromRoleToRole) {
  ASSERT_EQ(Body().joints.size(), BodyTreeLimbs().size());
  for (int trial = 0; trial < 10; ++trial) {
    const TreeState state = RandomPose(Body(), trial, 1.0);
    const BodyPose pose = ToBodyPose(Body(), state);
    const TreeFrames frames = ComputeFrames(Body(), state);
    for (std::size_t i = 0; i < Body().joints.size(); ++i) {
      const glm::dvec3 limb = pose[BodyTreeLimbs()[i].to] - pose[BodyTreeLimbs()[i].from];
      EXPECT_LT(glm::distance(glm::normalize(limb), frames.joints[i].axes[2]), 1e-12) << Body().joints[i].name;
    }
  }
}

TEST(BodyTree, StandsUprightFacingForwardWithHangingArms) {
  const BodyPose pose = ToBodyPose(Body(), StandingState(Body()));
  EXPECT_GT(pose[kLeftHip].x, pose[kRightHip].x) << "left is +X";
  EXPECT_GT(pose[kLeftShoulder].x, pose[kRightShoulder].x);
  EXPECT_NEAR(pose[kHead].y - pose[kHipCentre].y, 0.75, 1e-12);
  EXPECT_NEAR(pose[kLeftShoulder].y - pose[kLeftHand].y, 0.29 + 0.25 + 0.18, 1e-12);
  EXPECT_NEAR(pose[kRightHip].y - pose[kRightAnkle].y, 0.85, 1e-12);
  EXPECT_GT(pose[kLeftFoot].z, pose[kLeftAnkle].z + 0.1) << "toes point forward";
  EXPECT_GT(pose[kRightFoot].z, pose[kRightAnkle].z + 0.1);
  EXPECT_NEAR(pose[kLeftFoot].y, pose[kRightFoot].y, 1e-12);
  EXPECT_NEAR(glm::length(Facing(pose) - glm::dvec3(0, 0, 1)), 0, 1e-12);
}

// The signs of B6's limits: each joint bends further in its natural direction.
TEST(BodyTree, BendsTheWayPeopleBend) {
  const TreeState standing = StandingState(Body());
  const auto bent = [&](BodyTreeJoint joint, int axis, double degrees) {
    TreeState state = standing;
    state.angles[Body().joints[joint].first_dof + axis] = Radians(degrees);
    return ToBodyPose(Body(), state);
  };
  const BodyPose rest = ToBodyPose(Body(), standing);
  EXPECT_GT(bent(kTreeLeftElbow, 0, 90)[kLeftHand].z, rest[kLeftHand].z + 0.3);
  EXPECT_GT(bent(kTreeRightElbow, 0, 90)[kRightHand].z, rest[kRightHand].z + 0.3);
  EXPECT_GT(bent(kTreeLeftShoulder, 0, 170)[kLeftHand].y, rest[kHead].y);
  EXPECT_GT(bent(kTreeLeftShoulder, 1, -80)[kLeftHand].x, rest[kLeftHand].x + 0.3) << "left arm out to the left";
  EXPECT_LT(bent(kTreeRightShoulder, 1, 80)[kRightHand].x, rest[kRightHand].x - 0.3);
  EXPECT_GT(bent(kTreeRightHip, 0, 90)[kRightKnee].z, rest[kRightKnee].z + 0.3);
  EXPECT_LT(bent(kTreeRightKnee, 0, -90)[kRightFoot].z, rest[kRightAnkle].z);
  EXPECT_LT(bent(kTreeLeftKnee, 0, 90)[kLeftHip].z, rest[kLeftHip].z - 0.3) << "sitting down behind the foot";
  EXPECT_GT(bent(kTreeLeftHip, 2, -90)[kHead].z, rest[kHead].z + 0.3) << "trunk over the left thigh";
  EXPECT_GT(bent(kTreeNavel, 0, -60)[kHead].z, rest[kHead].z + 0.3) << "trunk bows forward";
  EXPECT_LT(bent(kTreeLeftAnkle, 0, 30)[kLeftKnee].z, rest[kLeftKnee].z - 0.1) << "plantarflexion: shank leans back";
}

TEST(BodyTree, LengthsMustBeFiniteAndPositive) {
  EXPECT_TRUE(IsValid(LimbLengths{}));
  EXPECT_FALSE(IsValid(LimbLengths{.shank = 0}));
  EXPECT_FALSE(IsValid(LimbLengths{.hand = -0.1}));
  EXPECT_FALSE(IsValid(LimbLengths{.neck = std::numeric_limits<double>::quiet_NaN()}));
}

}  // namespace
}  // namespace etude
