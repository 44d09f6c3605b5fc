#include "engine/retargeting/rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "engine/base/angles.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/engine/retargeting/turned_bodies.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

double AngleOf(const glm::dquat& q) { return 2 * std::atan2(glm::length(glm::dvec3(q.x, q.y, q.z)), std::abs(q.w)); }
double AngleBetweenTurns(const glm::dquat& a, const glm::dquat& b) { return AngleOf(glm::conjugate(a) * b); }

std::vector<GlobalTransform> Globals(const BodyPose& rest, const LocalPose& local) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(BodySkeleton(rest), local, globals);
  return globals;
}

double WorstJoint(const BodyPose& rest, const BodyPose& pose) {
  const std::vector<GlobalTransform> globals = Globals(rest, PoseRig(pose, rest));
  double worst = 0;
  for (const Role role : AllRoles()) {
    worst = std::max(worst, glm::distance(globals[Index(role)].position, pose[role]));
  }
  return worst;
}

BodyPose Moved(BodyPose pose, const glm::dquat& turn, const glm::dvec3& shift) {
  for (glm::dvec3& joint : pose.joints) joint = turn * joint + shift;
  return pose;
}

const glm::dquat kSomeTurn = glm::angleAxis(2.0, glm::normalize(glm::dvec3(1, 2, -3)));

TEST(PoseRig, AtRestTurnsNothing) {
  const BodyPose rest = StandingPose();
  const LocalPose local = PoseRig(rest, rest);
  const LocalPose expected = RestPose(BodySkeleton(rest));
  for (const Role role : AllRoles()) {
    EXPECT_LT(AngleOf(local[Index(role)].rotation), 1e-7) << RoleName(role);
    EXPECT_LT(glm::distance(local[Index(role)].translation, expected[Index(role)].translation), 1e-15);
    EXPECT_EQ(local[Index(role)].scale, glm::dvec3(1));
  }
}

TEST(PoseRig, TurnsOnlyTheRootWhenTheWholeBodyMoves) {
  const BodyPose rest = StandingPose();
  const LocalPose local = PoseRig(Moved(rest, kSomeTurn, {3, -1, 2}), rest);
  EXPECT_LT(AngleBetweenTurns(local[Index(kHipCentre)].rotation, kSomeTurn), 1e-7);
  for (const Role role : AllRoles()) {
    if (role == kHipCentre) continue;
    EXPECT_LT(AngleOf(local[Index(role)].rotation), 1e-7) << RoleName(role);
  }
}

struct Hinge {
  Role joint;
  glm::dvec3 axis;  // axis about which elbows and knees bend
};
class PoseRigAtAHinge : public ::testing::TestWithParam<Hinge> {};

TEST_P(PoseRigAtAHinge, GivesExactlyTheBend) {
  const BodyPose rest = AtAttention();
  for (const double degrees : {1.0, 20.0, 44.0, 90.0, 150.0}) {
    const glm::dquat bend = glm::angleAxis(Radians(degrees), GetParam().axis);
    const LocalPose local = PoseRig(Turned(rest, GetParam().joint, bend), rest);
    for (const Role role : AllRoles()) {
      const glm::dquat expected = role == GetParam().joint ? bend : glm::dquat(1, 0, 0, 0);
      EXPECT_LT(AngleBetweenTurns(local[Index(role)].rotation, expected), 1e-7) << RoleName(role) << " at " << degrees;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Limbs, PoseRigAtAHinge,
                         ::testing::Values(Hinge{kLeftElbow, {-1, 0, 0}}, Hinge{kRightElbow, {-1, 0, 0}},
                                           Hinge{kLeftKnee, {1, 0, 0}}, Hinge{kRightKnee, {1, 0, 0}}),
                         [](const auto& each) { return std::string(RoleName(each.param.joint)); });

TEST(PoseRig, SeesTheTwistOfAnUpperArmByItsBentElbow) {
  const BodyPose rest = StandingPose();
  const BodyPose bent = Turned(rest, kLeftElbow, glm::angleAxis(Radians(90), glm::dvec3(-1, 0, 0)));
  const glm::dquat twist = glm::angleAxis(Radians(50), glm::dvec3(0, 1, 0));
  const LocalPose local = PoseRig(Turned(bent, kLeftShoulder, twist), rest);
  EXPECT_LT(AngleBetweenTurns(local[Index(kLeftShoulder)].rotation, twist), 1e-7);
}

TEST(PoseRig, GivesTheMirrorImageOfAMirrorImage) {
  const BodyPose rest = StandingPose();
  ASSERT_OK(move, LoadBuiltinMove("boxing"));
  for (const BodyPose& pose : move->motion.poses) {
    const LocalPose local = PoseRig(pose, rest), mirrored = PoseRig(MirrorImage(pose), rest);
    for (const Role role : AllRoles()) {
      const glm::dquat q = mirrored[Index(Mirrored(role))].rotation;
      const glm::dquat reflected(q.w, q.x, -q.y, -q.z);
      ASSERT_LT(AngleBetweenTurns(local[Index(role)].rotation, reflected), 1e-6) << RoleName(role);
    }
  }
}

class PoseRigAlongAMove : public ::testing::TestWithParam<std::string> {};

TEST_P(PoseRigAlongAMove, PutsEveryJointWhereThePoseHasIt) {
  const BodyPose rest = StandingPose();
  ASSERT_OK(move, LoadBuiltinMove(GetParam()));
  for (BodyPose pose : move->motion.poses) {
    EXPECT_LT(WorstJoint(rest, pose), 1e-12);
    // The limbs may have other lengths than in the rest pose.
    for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] *= 0.6 + 0.01 * static_cast<double>(i);
    EXPECT_LT(WorstJoint(rest, pose), 1e-12);
  }
}

TEST_P(PoseRigAlongAMove, TurnsNoFasterThanLimbsDo) {
  const BodyPose rest = StandingPose();
  ASSERT_OK(move, LoadBuiltinMove(GetParam()));
  const Clip clip = RigClip(move->motion, rest, move->name);
  ASSERT_GT(clip.frames.size(), 10u);
  double worst = 0;
  std::string where;
  for (std::size_t frame = 1; frame < clip.frames.size(); ++frame) {
    for (const Role role : AllRoles()) {
      const glm::dquat before = clip.frames[frame - 1][Index(role)].rotation;
      const glm::dquat now = clip.frames[frame][Index(role)].rotation;
      EXPECT_GE(glm::dot(before, now), 0) << "signs of neighbours differ";
      const double turn = AngleBetweenTurns(before, now);
      if (turn > worst) where = std::string(RoleName(role)) + " in frame " + std::to_string(frame);
      worst = std::max(worst, turn);
    }
  }
  EXPECT_LT(Degrees(worst), 40) << where;
  RecordProperty("worst_deg", std::to_string(Degrees(worst)) + " " + where);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, PoseRigAlongAMove, ::testing::ValuesIn(BuiltinMoveNames()),
                         [](const auto& each) { return each.param; });

TEST(PoseRig, StaysFiniteForABodyWithoutSize) {
  const BodyPose rest = StandingPose();
  BodyPose point;
  for (glm::dvec3& joint : point.joints) joint = {1, 2, 3};
  BodyPose folded = Turned(rest, kLeftElbow, glm::angleAxis(kPi, glm::dvec3(1, 0, 0)));
  for (const BodyPose& pose : {point, folded}) {
    EXPECT_LT(WorstJoint(rest, pose), 1e-12);
    EXPECT_LT(WorstJoint(pose, rest), 1e-12);
    for (const LocalTransform& local : PoseRig(pose, rest)) EXPECT_NEAR(glm::length(local.rotation), 1, 1e-12);
  }
}

TEST(RigClip, KeepsFramesRateAndName) {
  const Clip clip = RigClip({.rate_hz = 25, .poses = {StandingPose(), StandingPose()}}, StandingPose(), "still");
  EXPECT_EQ(clip.name, "still");
  EXPECT_EQ(clip.rate_hz, 25);
  EXPECT_EQ(clip.frames.size(), 2u);
  EXPECT_EQ(clip.skeleton.joints.size(), kRoleCount);
  EXPECT_EQ(clip.skeleton.joints[Index(kLeftWrist)].name, "left_wrist");
}

}  // namespace
}  // namespace etude
