#include "engine/retargeting/leg_sides.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/retargeting/to_body.h"
#include "tests/engine/retargeting/turned_bodies.h"
#include "tests/support/body_of_person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;
using ::testing::HasSubstr;

/// A posture: the angles by which hips, knees and ankles bend, in radians; positive knees bend as a person's do, and
/// positive ankles point the toes.
struct Posture {
  const char* name;
  double hips, knees, ankles;
  std::string_view mirrored;  ///< what the mirror image shows
};

constexpr Posture kPostures[] = {{"standing", 0, 0, 0, "the feet point backwards"},
                                 {"squat", 1.6, 1.9, -0.5, "the feet point backwards"},
                                 {"kneeling", 0, 1.57, 1.2, "the knees bend backwards"},
                                 {"seiza", 1.7, 2.6, 1.0, "the knees bend backwards"},
                                 {"bridge", -0.5, 1.2, 0, "the feet point backwards"},
                                 {"toes pointed", 0, 0, 1.2, ""},
                                 {"overextended", 0, -0.5, 1.2, ""}};  // by 29°, as depth sensors show knees

LegSides LegsOf(const BodyPose& pose) {
  LegSides legs;
  const glm::dvec3 left = pose[kLeftHip] - pose[kRightHip];
  legs.Add(left, pose[kLeftHip], pose[kLeftKnee], pose[kLeftAnkle], pose[kLeftFoot]);
  legs.Add(left, pose[kRightHip], pose[kRightKnee], pose[kRightAnkle], pose[kRightFoot]);
  return legs;
}

TEST(LegSides, AreRightInEveryPostureAndExchangedInMostMirrorImages) {
  for (const Posture& posture : kPostures) {
    BodyPose pose = AtAttention();
    for (const auto& [hip, knee, ankle] :
         {std::array{kLeftHip, kLeftKnee, kLeftAnkle}, std::array{kRightHip, kRightKnee, kRightAnkle}}) {
      pose = Turned(pose, hip, glm::angleAxis(-posture.hips, glm::dvec3(1, 0, 0)));
      pose = Turned(pose, knee, glm::angleAxis(posture.knees, glm::dvec3(1, 0, 0)));
      pose = Turned(pose, ankle, glm::angleAxis(posture.ankles, glm::dvec3(1, 0, 0)));
    }
    BodyPose mirrored = pose;
    for (glm::dvec3& joint : mirrored.joints) joint.x = -joint.x;
    const LegSides legs = LegsOf(pose), image = LegsOf(mirrored);
    EXPECT_EQ(legs.Backwards(), "") << posture.name;
    EXPECT_EQ(image.Backwards(), posture.mirrored) << posture.name << " " << *legs.FeetForward();
    EXPECT_NEAR(*image.FeetForward(), -*legs.FeetForward(), 1e-12) << posture.name;
  }
  EXPECT_FALSE(LegsOf(BodyPose{}).FeetForward()) << "no legs";
  EXPECT_EQ(LegsOf(BodyPose{}).Backwards(), "");
}

TEST(LegSides, AKneelerIsConvertedAndAMirroredOneRefused) {
  for (const double mirror : {1.0, -1.0}) {
    Skeleton skeleton = testing::PersonSkeleton();
    for (Joint& joint : skeleton.joints) joint.rest.translation.x *= mirror;
    Clip clip = testing::AtRest(skeleton);
    for (const std::string side : {"Left", "Right"}) {
      testing::At(clip, 0, side + "Leg").rotation = testing::Turn(1.57, {1, 0, 0});
      testing::At(clip, 0, side + "Foot").rotation = testing::Turn(1.2, {1, 0, 0});
    }
    const auto body = ToBodyMotion(clip, FindJointMap(skeleton, "person.bvh").value(), "person.bvh");
    ASSERT_EQ(body.has_value(), mirror > 0) << testing::Message(body);
    if (!body) {
      EXPECT_THAT(body.error().message, HasSubstr("the knees bend backwards, so left and right are exchanged"));
    }
  }
}

}  // namespace
}  // namespace etude
