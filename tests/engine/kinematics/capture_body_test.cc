#include "engine/kinematics/capture_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/rest_bodies.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

// Fitted bodies have free angles; this share of their ranges is about a radian.
constexpr double kARadian = 0.1;

std::vector<CaptureBody> FittedBodies() {
  return {FittedBody(PlainRestBody()).value(), FittedBody(JointedRestBody()).value()};
}

TEST(CaptureBody, OfPaperBIsItsTree) {
  const CaptureBody body = PaperBody({});
  EXPECT_EQ(body.tree.dof_count(), 29);
  for (int trial = 0; trial < 20; ++trial) {
    const TreeState state = RandomPose(body.tree, trial, 1.0);
    const BodyPose pose = ToBodyPose(body, state), known = ToBodyPose(body.tree, state);
    for (const Role role : AllRoles()) EXPECT_LT(glm::distance(pose[role], known[role]), 1e-12) << RoleName(role);
  }
}

TEST(CaptureBody, ThatIsFittedKeepsItsLimbsInEveryPose) {
  const RestBody rest = PlainRestBody();
  const CaptureBody body = FittedBody(rest).value();
  for (int trial = 0; trial < 20; ++trial) {
    const BodyPose pose = ToBodyPose(body, RandomPose(body.tree, trial, kARadian));
    for (const Bone& bone : AllBones()) {
      EXPECT_NEAR(BoneLength(pose, bone), BoneLength(rest.Pose(), bone), 1e-12) << RoleName(bone.child);
      EXPECT_NEAR(body.bones[Index(bone.child)], BoneLength(rest.Pose(), bone), 1e-12);
    }
    EXPECT_NEAR(glm::distance(pose[kLeftHip], pose[kRightHip]), 0.18, 1e-12) << "the pelvis is rigid";
  }
}

TEST(CaptureBody, ThatIsFittedStandsWithHangingArms) {
  const RestBody rest = PlainRestBody();
  const CaptureBody body = FittedBody(rest).value();
  const BodyPose standing = ToBodyPose(body, StandingState(body.tree));
  const glm::dvec3 shift = rest.Pose()[kLeftFoot];
  for (const Role role : AllRoles()) {
    EXPECT_LT(glm::distance(standing[role] + shift, rest.Pose()[role]), 1e-12) << RoleName(role);
  }
}

// Each of 18 limbs has two degrees of freedom. Six of them also twist: the pelvis, the chest, the upper arms, a
// thigh, and the shank of the foot that is the root.
TEST(CaptureBody, ThatIsFittedHasTwoDegreesOfFreedomAndThreeWhereTwistsAreSeen) {
  EXPECT_EQ(FittedBody(PlainRestBody())->tree.dof_count(), 2 * 18 + 6);
  const CaptureBody jointed = FittedBody(JointedRestBody()).value();
  EXPECT_EQ(jointed.tree.joints.size(), FittedBody(PlainRestBody())->tree.joints.size() + 4) << "nubs are left out";
  EXPECT_TRUE(jointed.is_rigid[Index(kLeftKnee)]);
  for (const Role bent : {kLeftFoot, kRightFoot, kHead, kShoulderCentre}) EXPECT_FALSE(jointed.is_rigid[Index(bent)]);
}

TEST(CaptureBody, AsksOfEveryEndWhatASingleLimbShows) {
  const CaptureBody body = FittedBody(PlainRestBody()).value();
  ASSERT_EQ(body.ends.size(), 5u);
  const CaptureBody jointed = FittedBody(JointedRestBody()).value();
  ASSERT_EQ(jointed.ends.size(), 4u) << "of a foot that bends no limb runs along the stroke";
  for (const CaptureBody::End& end : jointed.ends) {
    EXPECT_EQ(end.has_direction, end.role == kLeftHand || end.role == kRightHand) << RoleName(end.role);
  }
}

// In the pose from which the targets were made, no target has an error.
TEST(CaptureBody, IsAtItsTargetsInThePoseThatWasSeen) {
  for (const CaptureBody& body : FittedBodies()) {
    for (int trial = 0; trial < 10; ++trial) {
      const TreeState state = RandomPose(body.tree, trial, kARadian);
      LimbObservation seen{.ends = ToBodyPose(body, state), .directions = {}};
      for (const Role limb : ObservedLimbs()) {
        seen.directions[Index(limb)] = seen.ends[limb] - seen.ends[*ParentOf(limb)];
      }
      const IkProblem problem = MakeImageProblem(body, seen, state);
      EXPECT_EQ(FindFault(body.tree, problem, {}), "");
      const TreeFrames frames = ComputeFrames(body.tree, state);
      for (std::size_t e = 0; e < problem.targets.size(); ++e) {
        const EffectorError error = ErrorOf(frames.effectors[e], problem.targets[e]);
        EXPECT_LT(body.ends[e].has_position ? error.position : 0, 1e-12);
        EXPECT_LT(body.ends[e].has_direction ? error.axis_angles.z : 0, 1e-9);
      }
    }
  }
}

TEST(CaptureBody, BecomesAClipWithItsJointsWhereTheyAre) {
  for (const CaptureBody& body : FittedBodies()) {
    std::vector<TreeState> states;
    for (int trial = 0; trial < 5; ++trial) states.push_back(RandomPose(body.tree, trial, kARadian));
    const Clip clip = ToClip(body, states, 30, "swing");
    std::vector<GlobalTransform> joints;
    for (std::size_t k = 0; k < states.size(); ++k) {
      const BodyPose pose = ToBodyPose(body, states[k]);
      ComputeGlobals(clip.skeleton, clip.frames[k], joints);
      const auto at = [&](const char* name) { return joints[clip.skeleton.Find(name)].position; };
      EXPECT_LT(glm::distance(at("hip_centre"), pose[kHipCentre]), 1e-9);
      EXPECT_LT(glm::distance(at("left_knee"), pose[kLeftKnee]), 1e-9);
      EXPECT_LT(glm::distance(at("left_ankle"), pose[kLeftAnkle]), 1e-9);
      EXPECT_LT(glm::distance(at("right_wrist"), pose[kRightWrist]), 1e-9);
      EXPECT_LT(glm::distance(at("head_end"), pose[kHead]), 1e-9);
      EXPECT_LT(glm::distance(at("left_foot_end"), pose[kLeftFoot]), 1e-9);
    }
  }
}

TEST(CaptureBody, WhoseHipsTurnHasItsHipCentreMidwayBetweenThem) {
  const BodyPose rest = SensorRestBody().Pose();
  const CaptureBody body = FittedBody(SensorRestBody()).value();
  EXPECT_TRUE(body.hips_turn);
  EXPECT_FALSE(FittedBody(JointedRestBody())->hips_turn);
  EXPECT_EQ(FindTreeFault(body.tree), "");
  std::vector<TreeState> states;
  for (int trial = 0; trial < 10; ++trial) states.push_back(RandomPose(body.tree, trial, kARadian));
  const Clip clip = ToClip(body, states, 30, "sensed");
  double least = 1, most = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const BodyPose pose = ToBodyPose(body, states[k]);
    EXPECT_LT(glm::distance(pose[kHipCentre], 0.5 * (pose[kLeftHip] + pose[kRightHip])), 1e-12);
    for (const Role hip : {kLeftHip, kRightHip}) {
      EXPECT_NEAR(glm::distance(pose[hip], pose[kSpine]), glm::distance(rest[hip], rest[kSpine]), 1e-12);
    }
    const double apart = glm::distance(pose[kLeftHip], pose[kRightHip]);
    least = std::min(least, apart), most = std::max(most, apart);
    std::vector<GlobalTransform> joints;
    ComputeGlobals(clip.skeleton, clip.frames[k], joints);
    const auto at = [&](const char* name) { return joints[clip.skeleton.Find(name)].position; };
    EXPECT_LT(glm::distance(at("right_hip"), pose[kRightHip]), 1e-9);
    EXPECT_LT(glm::distance(at("left_foot_end"), pose[kLeftFoot]), 1e-9);
    EXPECT_LT(glm::distance(at("right_wrist"), pose[kRightWrist]), 1e-9);
  }
  EXPECT_GT(most - least, 0.05) << "no rigid pelvis could follow";
}

TEST(CaptureBody, RefusesWhatIsNoBody) {
  RestBody apart = PlainRestBody();
  apart.joints.push_back({"lost", -1, {3, 0, 0}});
  apart.roles[Index(kLeftHand)].joint = static_cast<int>(apart.joints.size()) - 1;
  EXPECT_THAT(testing::Message(FittedBody(apart)), ::testing::HasSubstr("is not connected to the pelvis"));
  RestBody flat = PlainRestBody();
  for (const Role hip : {kLeftHip, kRightHip}) flat.roles[Index(hip)].position = flat.roles[Index(kHipCentre)].position;
  for (RestBody::Joint& joint : flat.joints) {
    if (joint.name == "left_hip" || joint.name == "right_hip") joint.position = flat.joints[0].position;
  }
  EXPECT_FALSE(FittedBody(flat));
}

}  // namespace
}  // namespace etude
