#include "engine/retargeting/to_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "engine/formats/bvh.h"
#include "engine/motion/sample.h"
#include "tests/support/person.h"

namespace etude {
namespace {

using enum Role;
using testing::At;
using testing::AtRest;
using ::testing::HasSubstr;
using testing::LowerArms;
using testing::Turn;

Result<BodyConversion> Convert(const Clip& clip) {
  const auto map = FindJointMap(clip.skeleton, "person.bvh");
  if (!map) return tl::unexpected(map.error());
  return ToBodyMotion(clip, *map, "person.bvh");
}

Skeleton Scaled(double factor) {
  Skeleton person = testing::PersonSkeleton();
  for (Joint& joint : person.joints) joint.rest.translation *= factor;
  return person;
}

TEST(ToBodyMotion, RecognisesTheUnitByTheBodysStature) {
  struct Case {
    double units_per_cm;
    const char* note;
  };
  for (const Case& unit : {Case{0.01, "1 unit = 100 cm (metre)"}, Case{1 / 30.48, "1 unit = 30.48 cm (foot)"},
                           Case{0.45 / 2.54, "1 unit = 5.644 cm (CMU)"}, Case{1 / 2.54, "1 unit = 2.54 cm (inch)"},
                           Case{1, "1 unit = 1 cm (centimetre)"}, Case{10, "1 unit = 0.1 cm (millimetre)"}}) {
    const auto body = Convert(AtRest(Scaled(unit.units_per_cm)));
    ASSERT_TRUE(body) << ToString(body.error());
    EXPECT_EQ(body->note, unit.note);
    EXPECT_NEAR(body->metres_per_unit * unit.units_per_cm, 0.01, 1e-12);
    EXPECT_NEAR(glm::distance(body->motion.poses[0][kLeftHip], body->motion.poses[0][kLeftKnee]), 0.43, 1e-12);
    EXPECT_NEAR(Stature(body->motion.poses[0]), 1.60 / 0.92, 1e-12);
  }
}

TEST(ToBodyMotion, ScalesABodyOfNoKnownUnitToACommonStature) {
  const auto body = Convert(AtRest(Scaled(1e-4)));
  ASSERT_TRUE(body) << ToString(body.error());
  EXPECT_NEAR(Stature(body->motion.poses[0]), 1.70, 1e-12);
  EXPECT_THAT(body->note, HasSubstr("unknown unit, scaled to a stature of 1.70 m"));
}

TEST(ToBodyMotion, DropsATPoseThatTheMotionJumpsAwayFrom) {
  Clip clip = AtRest(testing::PersonSkeleton(), 9, 120);
  for (std::size_t i = 1; i < 9; ++i) LowerArms(clip, i);
  const auto body = Convert(clip);
  ASSERT_TRUE(body);
  EXPECT_TRUE(body->dropped_t_pose);
  EXPECT_EQ(body->note, "1 unit = 1 cm (centimetre); dropped a leading T-pose");
  EXPECT_EQ(body->motion.poses.size(), 2u);  // frames 1 and 5 of 1…8
  EXPECT_FALSE(IsTPose(body->motion.poses[0]));
}

TEST(ToBodyMotion, KeepsATPoseThatTheMotionBeginsWith) {
  Clip lowering = AtRest(testing::PersonSkeleton(), 120, 120);
  for (std::size_t i = 0; i < 120; ++i) At(lowering, i, "LeftArm").rotation = Turn(-0.0125 * double(i), {0, 0, 1});
  for (const Clip& clip : {lowering, AtRest(testing::PersonSkeleton(), 1), AtRest(testing::PersonSkeleton(), 9)}) {
    const auto body = Convert(clip);
    ASSERT_TRUE(body);
    EXPECT_FALSE(body->dropped_t_pose);
    EXPECT_TRUE(IsTPose(body->motion.poses[0]));
  }
}

TEST(ToBodyMotion, KeepsAFirstFrameThatIsNoTPoseHoweverFarTheNextOneIs) {
  Clip clip = AtRest(testing::PersonSkeleton(), 9, 120);
  LowerArms(clip, 0);
  const auto body = Convert(clip);
  ASSERT_TRUE(body);
  EXPECT_FALSE(body->dropped_t_pose);
}

TEST(ToBodyMotion, ResamplesByTurningJointsSoThatLimbsKeepTheirLength) {
  // The arm sinks by 80° between two frames at 10 Hz; at 30 Hz its angle must be linear in time.
  Clip clip = AtRest(testing::PersonSkeleton(), 3, 10);
  for (std::size_t i = 0; i < 3; ++i) At(clip, i, "LeftArm").rotation = Turn(Radians(-40.0 * double(i)), {0, 0, 1});
  At(clip, 0, "RightArm").rotation = At(clip, 1, "RightArm").rotation = Turn(1.5, {0, 0, 1});
  const auto body = Convert(clip);
  ASSERT_TRUE(body);
  ASSERT_EQ(body->motion.poses.size(), 7u);
  EXPECT_EQ(body->motion.rate_hz, 30);
  for (std::size_t i = 0; i < 7; ++i) {
    const BodyPose& pose = body->motion.poses[i];
    const glm::dvec3 arm = pose[kLeftElbow] - pose[kLeftShoulder];
    EXPECT_NEAR(glm::length(arm), 0.29, 1e-12);
    EXPECT_NEAR(AngleBetween(arm, {1, 0, 0}), Radians(40.0 / 3 * double(i)), 1e-12);
  }
}

TEST(ToBodyMotion, KeepsFirstAndLastFrameWhenTheRatesDivide) {
  for (const int frames : {1, 4, 5, 8, 9, 2752}) {
    Clip clip = AtRest(testing::PersonSkeleton(), frames, 120);
    const auto body = Convert(clip);
    ASSERT_TRUE(body);
    EXPECT_EQ(body->motion.poses.size(), static_cast<std::size_t>((frames - 1) / 4 + 1)) << frames;
  }
}

TEST(ToBodyMotion, PutsTheFeetOnTheFloorAndLeavesTheRestOfThePlace) {
  Clip clip = AtRest(testing::PersonSkeleton(), 100);
  for (std::size_t i = 0; i < 100; ++i) At(clip, i, "Hips").translation = {300, 95 + 40, -200};
  At(clip, 50, "Hips").translation.y -= 90;  // one lost frame does not lift the clip
  At(clip, 70, "Hips").translation.y += 60;  // nor does a jump sink it
  const auto body = Convert(clip);
  ASSERT_TRUE(body);
  EXPECT_NEAR(body->motion.poses[0][kLeftFoot].y, 0, 1e-12);
  EXPECT_NEAR(body->motion.poses[0][kHipCentre].y, 0.9, 1e-12);
  EXPECT_NEAR(body->motion.poses[70][kLeftFoot].y, 0.6, 1e-12);
  EXPECT_NEAR(body->motion.poses[0][kHipCentre].x, 3, 1e-12);
  EXPECT_NEAR(body->motion.poses[0][kHipCentre].z, -2, 1e-12);
}

TEST(ToBodyMotion, TellsWhichRolesItComposed) {
  Skeleton person = testing::PersonSkeleton();
  person.joints[person.Find("LeftHand_End")].rest.translation = {0, 0, 0};
  const auto body = Convert(AtRest(person));
  ASSERT_TRUE(body);
  EXPECT_THAT(body->note, HasSubstr("; not in the file, composed: left_hand"));
}

TEST(ToBodyMotion, RefusesFilesWithOtherAxes) {
  Clip z_up = AtRest(testing::PersonSkeleton());
  At(z_up, 0, "Hips").rotation = Turn(kPi / 2, {1, 0, 0});
  const auto lying = Convert(z_up);
  ASSERT_FALSE(lying);
  EXPECT_EQ(ToString(lying.error()), "person.bvh: the body stands along Z; only files with Y up are read");

  Skeleton mirrored = testing::PersonSkeleton();
  for (Joint& joint : mirrored.joints) joint.rest.translation.x *= -1;
  const auto swapped = Convert(AtRest(mirrored));
  ASSERT_FALSE(swapped);
  EXPECT_THAT(swapped.error().message, HasSubstr("the feet point backwards"));
}

TEST(ToBodyMotion, RefusesWhatGivesNoMotion) {
  const auto empty = Convert(AtRest(testing::PersonSkeleton(), 0));
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().message, HasSubstr("no frames"));

  const auto tiny = Convert(AtRest(Scaled(1e-12)));
  ASSERT_FALSE(tiny);
  EXPECT_THAT(tiny.error().message, HasSubstr("it needs a size"));

  const auto endless = Convert(AtRest(testing::PersonSkeleton(), 400, 0.1));
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().message, "the clip lasts 3990 s; allowed: 3600 s");
}

TEST(ReadBodyMotion, GoesFromBytesToABodyAndPassesComplaintsOn) {
  const std::string text = WriteBvh(AtRest(testing::PersonSkeleton(), 31));
  const auto body = ReadBodyMotion(text, "person.bvh");
  ASSERT_TRUE(body) << ToString(body.error());
  EXPECT_EQ(body->motion.poses.size(), 31u);
  const auto broken = ReadBodyMotion(text.substr(0, 10), "person.bvh");
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().place.line, 2);
}

TEST(SampleClip, TurnsTheShortWayAndStaysWithinTheClip) {
  Clip clip = AtRest(testing::PersonSkeleton(), 2, 10);
  At(clip, 0, "LeftArm").rotation = Turn(0.2, {0, 0, 1});
  At(clip, 1, "LeftArm").rotation = -Turn(0.6, {0, 0, 1});  // the same rotation, written with the other sign
  At(clip, 1, "Hips").translation = {0, 105, 0};
  const int arm = clip.skeleton.Find("LeftArm");
  const LocalPose middle = SampleClip(clip, 0.05);
  EXPECT_NEAR(std::abs(glm::dot(middle[arm].rotation, Turn(0.4, {0, 0, 1}))), 1, 1e-14);
  EXPECT_NEAR(middle[0].translation.y, 100, 1e-12);
  EXPECT_EQ(SampleClip(clip, -1)[0].translation.y, 95);
  EXPECT_EQ(SampleClip(clip, 99)[0].translation.y, 105);
}

}  // namespace
}  // namespace etude
