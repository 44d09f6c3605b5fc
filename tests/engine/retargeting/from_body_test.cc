#include <gtest/gtest.h>

#include <cmath>

#include "engine/formats/bvh.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/rig.h"
#include "tests/support/gaps.h"
#include "tests/support/person.h"
#include "tests/support/read_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

BodyMotion Rubber() {
  BodyMotion motion;
  for (int frame = 0; frame < 3; ++frame) {
    BodyPose& pose = motion.poses.emplace_back();
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const double x = static_cast<double>(i);
      pose.joints[i] = {0.1 * x + 0.01 * frame, 1 + 0.03 * x * frame, 0.2 * frame - 0.07 * x};
    }
  }
  return motion;
}

TEST(FromBody, ForwardKinematicsGivesEveryPositionBackAlsoAfterAFile) {
  const BodyMotion motion = Rubber();
  const Clip clip = ToClip(motion, "rubber");
  ASSERT_OK(read, ReadBvh(WriteBvh(clip), "rubber.bvh"));
  EXPECT_EQ(read->rate_hz, 30);
  ASSERT_EQ(read->frames.size(), 3u);
  std::vector<GlobalTransform> globals;
  for (std::size_t frame = 0; frame < 3; ++frame) {
    for (const Clip* each : {&clip, &*read}) {
      ComputeGlobals(each->skeleton, each->frames[frame], globals);
      for (const Role role : AllRoles()) {
        const int joint = each->skeleton.Find(std::string(RoleName(role)));
        ASSERT_GE(joint, 0) << RoleName(role);
        EXPECT_LT(glm::distance(globals[joint].position, motion.poses[frame][role]), 1e-5) << RoleName(role);
      }
    }
  }
}

TEST(FromBody, IsAClipThatIsUnderstoodAsTheBodyItWas) {
  Clip person = testing::AtRest(testing::PersonSkeleton(), 3);
  for (std::size_t frame = 0; frame < 3; ++frame) testing::LowerArms(person, frame);
  ASSERT_OK(map, FindJointMap(person.skeleton, "person.bvh"));
  const BodyMotion motion = ToBodyMotion(person, *map, "person.bvh")->motion;
  ASSERT_OK(read, testing::ReadBody(WriteBvh(ToClip(motion, "person")), "person.bvh"));
  ASSERT_EQ(read->motion.poses.size(), motion.poses.size());
  EXPECT_LT(WorstJointDistance(read->motion.poses[1], motion.poses[1]), 1e-3);
}

// A body lies face down on a bench, and its hands move up and down beside the bench.
TEST(FromBody, ThatLiesOnABenchStillLiesAfterAFile) {
  const Clip person = testing::AtRest(testing::PersonSkeleton(), 60);
  ASSERT_OK(map, FindJointMap(person.skeleton, "person.bvh"));
  BodyMotion motion = ToBodyMotion(person, *map, "person.bvh")->motion;
  const BodyPose rest = motion.poses.front();
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    BodyPose& pose = motion.poses[t];
    for (glm::dvec3& p : pose.joints) p = {p.x, .6 - p.z, p.y};
    for (const Role hand : {Role::kLeftHand, Role::kRightHand}) pose[hand].y -= .4 + .2 * std::sin(.3 * t);
  }
  ASSERT_OK(read, testing::ReadBody(WriteBvh(RigClip(motion, rest, "bench")), "bench.bvh"));
  EXPECT_EQ(read->found_up.evidence, UpEvidence::kFile) << "no posture can overrule Y";
  ASSERT_EQ(read->motion.poses.size(), motion.poses.size());
  for (const std::size_t t : {0u, 30u}) {
    const auto along = [t](const BodyMotion& of) { return of.poses[t][Role::kHead] - of.poses[t][Role::kHipCentre]; };
    EXPECT_LT(glm::distance(along(read->motion), along(motion)), 1e-3) << t;
  }
}

}  // namespace
}  // namespace etude
