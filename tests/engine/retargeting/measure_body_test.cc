#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/retargeting/proportions.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

/// Returns the person of person.h in centimetres; only elbows, knees and the second neck joint move.
Clip Moving() {
  Clip clip = testing::AtRest(testing::PersonSkeleton(), 20);
  for (std::size_t k = 0; k < clip.frames.size(); ++k) {
    const double angle = 0.4 * std::sin(0.3 * static_cast<double>(k));
    for (const char* name : {"Hips", "LeftForeArm", "RightForeArm", "LeftLeg", "RightLeg", "Head", "LeftArm"}) {
      const int joint = clip.skeleton.Find(name);
      clip.frames[k][joint].rotation = glm::angleAxis(angle, glm::dvec3(0, 0.6, 0.8)) * clip.frames[k][joint].rotation;
    }
  }
  return clip;
}

struct Measured {
  RestBody body;
  BodyConversion conversion;
};

Measured Measure(const Clip& clip) {
  const auto map = FindJointMap(clip.skeleton, "person.bvh");
  EXPECT_TRUE(map) << ToString(map.error());
  const auto conversion = ToBodyMotion(clip, *map, "person.bvh");
  EXPECT_TRUE(conversion) << ToString(conversion.error());
  return {MeasureBody(clip, *map, *conversion), *conversion};
}

bool Has(const RestBody& body, const std::string& name) {
  return std::ranges::any_of(body.joints, [&](const RestBody::Joint& joint) { return joint.name == name; });
}

TEST(MeasureBody, IsInMetresAndFacesAhead) {
  const BodyPose rest = Measure(Moving()).body.Pose();
  EXPECT_NEAR(glm::distance(rest[kLeftShoulder], rest[kLeftElbow]), 0.29, 1e-9);
  EXPECT_NEAR(glm::distance(rest[kRightKnee], rest[kRightAnkle]), 0.42, 1e-9);
  EXPECT_NEAR(glm::distance(rest[kLeftHip], rest[kRightHip]), 0.18, 1e-9);
  EXPECT_GT(rest[kLeftHand].x, rest[kRightHand].x);
  EXPECT_GT(rest[kLeftFoot].z, rest[kLeftAnkle].z);
  EXPECT_GT(rest[kHead].y, rest[kHipCentre].y);
}

TEST(MeasureBody, HasTheJointsThatTurnAndNoOthers) {
  const RestBody body = Measure(Moving()).body;
  for (const char* name : {"Hips", "LeftArm", "LeftForeArm", "RightForeArm", "LeftLeg", "Head"}) {
    EXPECT_TRUE(Has(body, name)) << name;
  }
  for (const char* name : {"Spine", "Neck", "RightArm", "LeftToeBase", "Head_End"})
    EXPECT_FALSE(Has(body, name)) << name;
  for (std::size_t i = 1; i < body.joints.size(); ++i) EXPECT_LT(body.joints[i].parent, static_cast<int>(i));
  EXPECT_EQ(body.joints[body.roles[Index(kHead)].joint].name, "Head");
}

TEST(MeasureBody, IsMadeOfTheRolesWhereTheyDoNotHangOnTheHips) {
  const Clip clip = Moving();
  auto map = FindJointMap(clip.skeleton, "person.bvh");
  ASSERT_OK(conversion, ToBodyMotion(clip, *map, "person.bvh"));
  EXPECT_EQ(MeasureBody(clip, *map, *conversion).joints.front().name, "Hips");
  map->points[Index(kHipCentre)].joint = clip.skeleton.Find("LeftLeg");  // hips that carry only a shank
  const RestBody roles = MeasureBody(clip, *map, *conversion);
  EXPECT_EQ(roles.joints.front().name, "hip_centre");
  EXPECT_EQ(roles.joints.size(), RestBodyOf(conversion->motion.poses).joints.size());
}

// A joint whose angle never changes is rigid, and the measured body keeps this angle.
TEST(MeasureBody, KeepsWhatAlwaysStaysAsItIs) {
  Clip clip = Moving();
  const int toe = clip.skeleton.Find("LeftToeBase");
  for (LocalPose& frame : clip.frames) frame[toe].rotation = glm::angleAxis(Radians(30), glm::dvec3(1, 0, 0));
  const Measured bent = Measure(clip);
  const BodyPose rest = bent.body.Pose();
  for (const BodyPose& pose : bent.conversion.motion.poses) {
    EXPECT_NEAR(glm::distance(rest[kLeftAnkle], rest[kLeftFoot]), glm::distance(pose[kLeftAnkle], pose[kLeftFoot]),
                1e-9);
  }
  const BodyPose straight = Measure(Moving()).body.Pose();
  EXPECT_GT(std::abs(glm::distance(rest[kLeftAnkle], rest[kLeftFoot]) -
                     glm::distance(straight[kLeftAnkle], straight[kLeftFoot])),
            1e-3)
      << "the control";
}

}  // namespace
}  // namespace etude
