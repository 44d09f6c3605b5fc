
#include <gtest/gtest.h>

#include "engine/formats/bvh.h"
#include "engine/kinematics/body_tree.h"
#include "engine/retargeting/joint_map.h"
#include "tests/engine/kinematics/observed_tree.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

std::vector<TreeState> SomeStates(const KinematicTree& tree) {
  std::vector<TreeState> states;
  for (int trial = 0; trial < 10; ++trial) states.push_back(RandomPose(tree, trial, 1.0));
  return states;
}

// Checks one frame of `clip` against `pose`; returns the number of compared joints.
int ExpectPose(const Clip& clip, const LocalPose& frame, const BodyPose& pose, double tolerance) {
  const std::vector<std::pair<std::string, Role>> expected = {
      {"Hips", kHipCentre},         {"Spine", kSpine},
      {"Neck", kShoulderCentre},    {"Head", kHead},
      {"LeftArm", kLeftShoulder},   {"LeftForeArm", kLeftElbow},
      {"LeftHand", kLeftWrist},     {"LeftHand_End", kLeftHand},
      {"RightArm", kRightShoulder}, {"RightForeArm", kRightElbow},
      {"RightHand", kRightWrist},   {"RightHand_End", kRightHand},
      {"LeftUpLeg", kLeftHip},      {"LeftLeg", kLeftKnee},
      {"LeftFoot", kLeftAnkle},     {"LeftFoot_End", kLeftFoot},
      {"RightUpLeg", kRightHip},    {"RightLeg", kRightKnee},
      {"RightFoot", kRightAnkle},   {"RightFoot_End", kRightFoot}};
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, frame, globals);
  int compared = 0;
  for (const auto& [name, role] : expected) {
    const int joint = clip.skeleton.Find(name);
    EXPECT_GE(joint, 0) << name;
    if (joint < 0) continue;
    EXPECT_LT(glm::distance(globals[joint].position, pose[role]), tolerance) << name;
    ++compared;
  }
  return compared;
}

TEST(TreeToBody, TheClipPutsAllTwentyJointsWhereTheTreeHasThem) {
  const std::vector<TreeState> states = SomeStates(Body());
  const Clip clip = ToClip(Body(), states, 30, "captured");
  ASSERT_EQ(clip.frames.size(), states.size());
  for (std::size_t f = 0; f < states.size(); ++f) {
    EXPECT_EQ(ExpectPose(clip, clip.frames[f], ToBodyPose(Body(), states[f]), 1e-12), 20);
  }
}

TEST(TreeToBody, OnlyTheRootMovesWithinItsParent) {
  const Clip clip = ToClip(Body(), SomeStates(Body()), 30, "captured");
  for (const LocalPose& frame : clip.frames) {
    for (std::size_t j = 1; j < frame.size(); ++j) {
      EXPECT_EQ(frame[j].translation, clip.skeleton.joints[j].rest.translation) << "limbs are rigid";
      if (clip.skeleton.joints[j].is_end_site) {
        EXPECT_NEAR(std::abs(frame[j].rotation.w), 1, 1e-12) << "an end site has no channels";
      }
    }
  }
}

TEST(TreeToBody, TheClipSurvivesABvhFile) {
  const std::vector<TreeState> states = SomeStates(Body());
  ASSERT_OK(read, ReadBvh(WriteBvh(ToClip(Body(), states, 30, "captured")), "captured.bvh"));
  for (std::size_t f = 0; f < states.size(); ++f) {
    EXPECT_EQ(ExpectPose(*read, read->frames[f], ToBodyPose(Body(), states[f]), 1e-5), 20) << "six decimals";
  }
}

TEST(TreeToBody, TheClipsJointsAreFoundByTheirNames) {
  const std::vector<TreeState> states = SomeStates(Body());
  const Clip clip = ToClip(Body(), states, 30, "captured");
  ASSERT_OK(map, FindJointMap(clip.skeleton, "captured.bvh"));
  EXPECT_TRUE(map->composed.empty());
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames[0], globals);
  const BodyPose mapped = Evaluate(*map, globals), expected = ToBodyPose(Body(), states[0]);
  for (Role role : AllRoles()) EXPECT_LT(glm::distance(mapped[role], expected[role]), 1e-12) << RoleName(role);
}

TEST(TreeToBody, TheSpineLiesOnTheTrunk) {
  const BodyPose pose = ToBodyPose(Body(), RandomPose(Body(), 0, 1.0));
  EXPECT_NEAR(glm::distance(pose[kHipCentre], pose[kSpine]), kSpineShare * 0.5, 1e-12);
  EXPECT_NEAR(glm::distance(pose[kSpine], pose[kShoulderCentre]), (1 - kSpineShare) * 0.5, 1e-12);
  EXPECT_LT(glm::distance(pose[kHipCentre], 0.5 * (pose[kLeftHip] + pose[kRightHip])), 1e-12);
}

}  // namespace
}  // namespace etude
