#include "engine/retargeting/proportions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <tuple>

#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/support/gaps.h"
#include "tests/support/read_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

/// Longer legs, shorter arms and a short trunk: not a uniform scale.
BodyPose Lanky() {
  const BodyPose standing = StandingPose();
  BodyPose body;
  for (const Bone& bone : AllBones()) {
    const bool leg = bone.child >= kLeftKnee && bone.child != kRightHip;
    const bool arm = bone.child >= kLeftShoulder && bone.child <= kRightHand;
    const double factor = leg ? 1.2 : arm ? 0.8 : 0.7;
    body[bone.child] = body[bone.parent] + factor * (standing[bone.child] - standing[bone.parent]);
  }
  return body;
}

BodyPose Scaled(BodyPose pose, double factor) {
  for (glm::dvec3& joint : pose.joints) joint *= factor;
  return pose;
}

BodyMotion MoveMotion(const std::string& name) {
  const auto move = LoadBuiltinMove(name);
  EXPECT_TRUE(move) << ToString(move.error());
  return move->motion;
}

double WorstLength(const BodyMotion& motion, const BodyPose& body) {
  double worst = 0;
  for (const BodyPose& pose : motion.poses) {
    for (const Bone& bone : AllBones()) {
      worst = std::max(worst, std::abs(BoneLength(pose, bone) - BoneLength(body, bone)));
    }
  }
  return worst;
}

/// Returns the distance (m) that the fastest joint moves from the previous frame to `frame`. Hands are left out: in
/// files they end anywhere from the wrist to the finger tips, so a hand with new proportions may be three times as
/// long and fast.
double FastestStep(const BodyMotion& motion, std::size_t frame) {
  double fastest = 0;
  for (const Role role : AllRoles()) {
    if (role == kLeftHand || role == kRightHand) continue;
    fastest = std::max(fastest, glm::distance(motion.poses[frame][role], motion.poses[frame - 1][role]));
  }
  return fastest;
}

/// Returns the distance (m) that toes near the floor travel along it, over both feet and all frames. Heights are shares
/// of `stature`, so that bodies of any size use the same moments.
double Slide(const BodyMotion& motion, double stature) {
  double slide = 0;
  for (const Role foot : {kLeftFoot, kRightFoot}) {
    for (std::size_t frame = 1; frame < motion.poses.size(); ++frame) {
      const glm::dvec3 a = motion.poses[frame - 1][foot], b = motion.poses[frame][foot];
      if (std::max(a.y, b.y) < 0.03 * stature) slide += std::hypot(b.x - a.x, b.z - a.z);
    }
  }
  return slide;
}

class Retargeted : public ::testing::TestWithParam<std::string> {};

TEST_P(Retargeted, HasTheTargetsLimbs) {
  EXPECT_LT(WorstLength(Retarget(MoveMotion(GetParam()), Lanky()), Lanky()), 1e-9);
}

TEST_P(Retargeted, IsTheSameMotionOnTheSameBody) {
  const BodyMotion motion = MoveMotion(GetParam());
  EXPECT_LT(WorstJointDistance(Retarget(motion, StandingPose()), motion), 1e-9);
}

TEST_P(Retargeted, IsTheScaledMotionOnAScaledBody) {
  BodyMotion motion = MoveMotion(GetParam());
  const BodyMotion child = Retarget(motion, Scaled(StandingPose(), 0.65));
  for (BodyPose& pose : motion.poses) pose = Scaled(pose, 0.65);
  EXPECT_LT(WorstJointDistance(child, motion), 1e-9);
}

TEST_P(Retargeted, StandsAndSlidesAsBefore) {
  const BodyMotion motion = MoveMotion(GetParam());
  const BodyMotion lanky = Retarget(motion, Lanky());
  constexpr double kScale = 1.2, kStature = 1.7;
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    for (const Role foot : {kLeftFoot, kRightFoot}) {
      const glm::dvec3 before = motion.poses[frame][foot], after = lanky.poses[frame][foot];
      if (before.y < 0.05) {
        EXPECT_LT(glm::distance(after, kScale * before), 1e-9) << "frame " << frame;
      } else {
        EXPECT_GT(after.y, 0.02);
      }
    }
  }
  EXPECT_LE(Slide(lanky, kScale * kStature), kScale * Slide(motion, kStature) + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, Retargeted, ::testing::ValuesIn(BuiltinMoveNames()),
                         [](const auto& each) { return each.param; });

TEST(RetargetedSlide, IsSeenWhereFeetSlide) {
  BodyMotion motion{.rate_hz = 30, .poses = {StandingPose(), StandingPose()}};
  for (glm::dvec3& joint : motion.poses[1].joints) joint.x += 0.1;
  EXPECT_NEAR(Slide(motion, 1.7), 0.2, 1e-12);
}

TEST(RetargetedRealClip, HasTheTargetsLimbsAndJumpsNowhere) {
  for (const char* name : {"01_01.bvh", "Boxing_Toes.bvh"}) {
    std::ifstream in(std::string("/usr/share/assimp/models/BVH/") + name, std::ios::binary);
    ASSERT_TRUE(in) << "not installed: package assimp-testmodels";
    ASSERT_OK(read, testing::ReadBody(std::string(std::istreambuf_iterator<char>(in), {}), name));
    const BodyMotion& motion = read->motion;
    const BodyMotion retargeted = Retarget(motion, StandingPose());
    EXPECT_LT(WorstLength(retargeted, StandingPose()), 1e-9) << name;
    ASSERT_EQ(retargeted.poses.size(), motion.poses.size());
    for (std::size_t frame = 1; frame < motion.poses.size(); ++frame) {
      const double before = FastestStep(motion, frame), after = FastestStep(retargeted, frame);
      ASSERT_LT(after, 2 * before + 0.02) << name << " in frame " << frame;
    }
  }
}

TEST(RetargetedRealClip, OfAMeasuredBodyWithJitteringLimbsIsAsSteadyAsItsTarget) {
  BodyMotion motion = MoveMotion("aerobic");
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      motion.poses[frame].joints[i] +=
          0.02 * glm::dvec3(std::sin(7.1 * frame + i), std::sin(5.3 * frame + 2 * i), std::sin(3.7 * frame + 3 * i));
    }
  }
  EXPECT_LT(WorstLength(Retarget(motion, Lanky()), Lanky()), 1e-9);
}

TEST(RetargetedBodyWithoutSomeLimbs, StaysFinite) {
  BodyPose no_thighs = StandingPose(), no_legs = StandingPose();
  for (const auto& [hip, knee, ankle] :
       {std::tuple{kLeftHip, kLeftKnee, kLeftAnkle}, std::tuple{kRightHip, kRightKnee, kRightAnkle}}) {
    no_thighs[knee] = no_thighs[hip];
    no_legs[knee] = no_legs[ankle] = no_legs[hip];
  }
  const BodyMotion motion = MoveMotion("side_kick");
  for (const BodyPose& body : {no_thighs, no_legs, BodyPose{}}) {
    for (const BodyMotion& retargeted : {Retarget(motion, body), Retarget({.poses = {body, body}}, StandingPose())}) {
      for (const BodyPose& pose : retargeted.poses) {
        for (const glm::dvec3& joint : pose.joints) ASSERT_TRUE(std::isfinite(glm::dot(joint, joint)));
      }
    }
  }
}

TEST(RetargetedEmptyMotion, StaysEmpty) { EXPECT_TRUE(Retarget({}, StandingPose()).poses.empty()); }

}  // namespace
}  // namespace etude
