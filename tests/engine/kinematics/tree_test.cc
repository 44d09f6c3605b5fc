#include "engine/kinematics/tree.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/tree_to_body.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

using enum Role;

// Forward kinematics once more, by 4×4 matrices from the tip of a chain to its root.
glm::dmat4 ChainMatrix(const KinematicTree& tree, const TreeState& state, int joint_index) {
  const TreeJoint& joint = tree.joints[joint_index];
  if (joint.parent < 0) return glm::translate(glm::dmat4(1), state.root_position) * glm::dmat4(state.root_frame);
  glm::dmat4 local = glm::translate(glm::dmat4(1), joint.p_PJ) * glm::dmat4(joint.R_PJ);
  const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < joint.dof_count; ++k) local = glm::rotate(local, state.angles[joint.first_dof + k], axes[k]);
  return ChainMatrix(tree, state, joint.parent) * local;
}

TEST(Tree, AnAngleIsClampedToTheEndNearestOnTheCircle) {
  const AngleRange raise{Radians(-50), Radians(170)};
  for (const auto& [angle, clamped] :
       {std::pair{20.0, 20.0}, {-60.0, -50.0}, {185.0, 170.0}, {-175.0, 170.0}, {-110.0, -50.0}, {380.0, 20.0}}) {
    EXPECT_NEAR(Degrees(ClampAngle(Radians(angle), raise)), clamped, 1e-9) << angle;
  }
}

TEST(Tree, HasPaperBs29DegreesOfFreedomAndFourEffectors) {
  const KinematicTree tree = MakeBodyTree({});
  EXPECT_EQ(tree.dof_count(), 29);
  ASSERT_EQ(tree.effectors.size(), 4u);
  EXPECT_EQ(tree.effectors[0].name, "right_foot");
  EXPECT_EQ(tree.effectors[3].name, "head");
}

TEST(Tree, ForwardKinematicsAgreesWithMatrixProductsAlongEveryChain) {
  const KinematicTree tree = MakeBodyTree({});
  for (int trial = 0; trial < 20; ++trial) {
    const TreeState state = RandomPose(tree, trial, 1.0);
    const TreeFrames frames = ComputeFrames(tree, state);
    for (std::size_t j = 0; j < tree.joints.size(); ++j) {
      const glm::dmat4 expected = ChainMatrix(tree, state, static_cast<int>(j));
      EXPECT_LT(glm::length(frames.joints[j].position - glm::dvec3(expected[3])), 1e-13) << tree.joints[j].name;
      for (int k = 0; k < 3; ++k) {
        EXPECT_LT(glm::length(frames.joints[j].axes[k] - glm::dvec3(expected[k])), 1e-13) << tree.joints[j].name;
      }
    }
    for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
      const glm::dvec4 tip(tree.effectors[e].p_LE, 1);
      const glm::dvec4 expected = ChainMatrix(tree, state, tree.effectors[e].joint) * tip;
      EXPECT_LT(glm::length(frames.effectors[e].position - glm::dvec3(expected)), 1e-13) << tree.effectors[e].name;
    }
  }
}

TEST(Tree, DofAxesGiveTheDerivativeOfEveryEffector) {
  const KinematicTree tree = MakeBodyTree({});
  const TreeState state = RandomPose(tree, 3, 0.9);
  const TreeFrames frames = ComputeFrames(tree, state);
  constexpr double kStep = 1e-6;
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    for (int j = tree.effectors[e].joint; j >= 0; j = tree.joints[j].parent) {
      for (int axis = 0; axis < tree.joints[j].dof_count; ++axis) {
        TreeState ahead = state, behind = state;
        ahead.angles[tree.joints[j].first_dof + axis] += kStep;
        behind.angles[tree.joints[j].first_dof + axis] -= kStep;
        const LimbFrame a = ComputeFrames(tree, ahead).effectors[e], b = ComputeFrames(tree, behind).effectors[e];
        const glm::dvec3 turn = DofAxis(tree.joints[j], frames.R_WJ[j], state.angles, axis);
        const glm::dvec3 arm = frames.effectors[e].position - frames.joints[j].position;
        EXPECT_LT(glm::length((a.position - b.position) / (2 * kStep) - glm::cross(turn, arm)), 1e-9);
        EXPECT_LT(glm::length((a.axes[1] - b.axes[1]) / (2 * kStep) - glm::cross(turn, frames.effectors[e].axes[1])),
                  1e-9);
      }
    }
  }
}

TEST(Tree, StandsUprightFacingForwardWithHangingArms) {
  const KinematicTree tree = MakeBodyTree({});
  const BodyPose pose = ToBodyPose(tree, StandingState(tree));
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

// The signs of B6's limits: each joint's wider side is the way that joint really bends.
TEST(Tree, BendsTheWayPeopleBend) {
  const KinematicTree tree = MakeBodyTree({});
  const TreeState standing = StandingState(tree);
  const auto bent = [&](BodyTreeJoint joint, int axis, double degrees) {
    TreeState state = standing;
    state.angles[tree.joints[joint].first_dof + axis] = Radians(degrees);
    return ToBodyPose(tree, state);
  };
  const BodyPose rest = ToBodyPose(tree, standing);
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

TEST(Tree, LengthsMustBeFiniteAndPositive) {
  EXPECT_TRUE(IsValid(LimbLengths{}));
  EXPECT_FALSE(IsValid(LimbLengths{.shank = 0}));
  EXPECT_FALSE(IsValid(LimbLengths{.hand = -0.1}));
  EXPECT_FALSE(IsValid(LimbLengths{.neck = std::numeric_limits<double>::quiet_NaN()}));
}

}  // namespace
}  // namespace etude
