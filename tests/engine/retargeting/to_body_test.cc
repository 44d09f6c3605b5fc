#include "engine/retargeting/to_body.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/motion/statistics.h"
#include "tests/support/body_of_person.h"
#include "tests/support/gaps.h"
#include "tests/support/person.h"
#include "tests/support/read_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;
using testing::At;
using testing::AtRest;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::LowerArms;
using testing::Turn;

Result<BodyConversion> Convert(const Clip& clip, const BodyOptions& options = {}) {
  return testing::ToBody(clip, "person.bvh", options);
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
    ASSERT_OK(body, Convert(AtRest(Scaled(unit.units_per_cm))));
    EXPECT_EQ(body->Note(), unit.note);
    EXPECT_NEAR(body->metres_per_unit * unit.units_per_cm, 0.01, 1e-12);
    EXPECT_NEAR(glm::distance(body->motion.poses[0][kLeftHip], body->motion.poses[0][kLeftKnee]), 0.43, 1e-12);
    EXPECT_NEAR(Stature(body->motion.poses[0]), 1.60 / 0.92, 1e-12);
  }
}

TEST(ToBodyMotion, ScalesABodyOfNoKnownUnitToACommonStature) {
  ASSERT_OK(body, Convert(AtRest(Scaled(1e-4))));
  EXPECT_NEAR(Stature(body->motion.poses[0]), 1.70, 1e-12);
  EXPECT_THAT(body->Note(), HasSubstr("unknown unit; Etude scaled the body to a height of 1.70 m"));
}

TEST(ToBodyMotion, TakesSmallBodiesInMillimetresForWhatASensorSaw) {
  EXPECT_EQ(Convert(AtRest(Scaled(10 * 0.75)))->unit, "millimetre") << "1.30 m";
  EXPECT_EQ(Convert(AtRest(Scaled(0.01 * 0.75)))->unit, "unknown") << "a toy or a child, in metres";
  EXPECT_EQ(Convert(AtRest(Scaled(10 * 0.65)))->unit, "unknown") << "1.13 m";
}

TEST(ToBodyMotion, ChildrenKeepTheirStatureIfTheFileStatesMetres) {
  const double adult_m = 1.60 / 0.92;
  const auto convert = [&](double stature_m, bool states_metres) {
    return Convert(AtRest(Scaled(0.01 * stature_m / adult_m)), {.states_metres = states_metres});
  };
  for (const double stature_m : {0.6, 0.9, 1.2, 1.4, 1.74, 2.4, 2.9}) {
    ASSERT_OK(body, convert(stature_m, true));
    EXPECT_EQ(body->unit, "metre") << stature_m;
    EXPECT_NEAR(Stature(body->motion.poses[0]), stature_m, 1e-9);
    EXPECT_THAT(body->Note(), Not(HasSubstr("states")));
    ASSERT_OK(small, convert(0.01 * stature_m, true));
    EXPECT_EQ(small->unit, "metre, divided by 100") << stature_m;
    EXPECT_NEAR(Stature(small->motion.poses[0]), stature_m, 1e-9);
    // The control: without a statement, only an adult's stature tells the unit.
    ASSERT_OK(guessed, convert(stature_m, false));
    EXPECT_NEAR(Stature(guessed->motion.poses[0]), stature_m == 1.74 ? stature_m : 1.70, 1e-9);
  }
  // Files that state metres, but hold millimetres, metres that were taken as centimetres, centimetres, inches, or feet.
  for (const auto& [units, unit] : {std::pair(1e-4, "unknown"),
                                    {0.01, "metre, divided by 100"},
                                    {100.0, "centimetre"},
                                    {1 / 0.0254, "inch"},
                                    {1 / 0.3048, "foot"}}) {
    ASSERT_OK(body, convert(units * adult_m, true));
    EXPECT_EQ(body->unit, unit);
    EXPECT_NEAR(Stature(body->motion.poses[0]), *unit == 'u' ? 1.70 : adult_m, 1e-9);
    EXPECT_THAT(body->doubts,
                ::testing::ElementsAre(HasSubstr(fmt::format(
                    "the unit that the file or the file format states, because the body would be {:.3g} m tall",
                    units * adult_m))));
  }
  // Inches in a file that states centimetres: 0.69 m, with an adult's long legs.
  ASSERT_OK(body, convert(adult_m / 2.54, true));
  EXPECT_THAT(body->doubts, ::testing::ElementsAre(HasSubstr("the legs have an adult's proportion of the height")));
}

TEST(ToBodyMotion, DropsATPoseThatTheMotionJumpsAwayFrom) {
  Clip clip = AtRest(testing::PersonSkeleton(), 9, 120);
  for (std::size_t i = 1; i < 9; ++i) LowerArms(clip, i);
  ASSERT_OK(body, Convert(clip));
  EXPECT_EQ(body->dropped_frames, 1u);
  EXPECT_EQ(body->Note(), "1 unit = 1 cm (centimetre); dropped a leading T-pose; resampled from 120 to 30 Hz");
  EXPECT_EQ(body->motion.poses.size(), 2u);  // frames 1 and 5 of 1…8
  EXPECT_FALSE(IsTPose(body->motion.poses[0]));
}

TEST(ToBodyMotion, DropsEveryFrameOfATPoseThatIsHeld) {
  Clip clip = AtRest(testing::PersonSkeleton(), 9, 30);
  for (std::size_t i = 3; i < 9; ++i) LowerArms(clip, i);
  ASSERT_OK(body, Convert(clip));
  EXPECT_EQ(body->Note(), "1 unit = 1 cm (centimetre); dropped a leading T-pose of 3 frames");
  EXPECT_EQ(body->dropped_frames, 3u);
  EXPECT_EQ(body->motion.poses.size(), 6u);
  ASSERT_OK(whole, Convert(clip, {.drop_t_pose = false}));
  EXPECT_EQ(whole->dropped_frames, 0u);
  EXPECT_EQ(whole->motion.poses.size(), 9u);
  EXPECT_THAT(whole->doubts,
              ::testing::ElementsAre("the motion begins with 3 frames of a T-pose, from which it jumps"));
  EXPECT_THAT(body->doubts, ::testing::IsEmpty());
}

TEST(ToBodyMotion, KeepsATPoseThatTheMotionBeginsWith) {
  Clip lowering = AtRest(testing::PersonSkeleton(), 120, 120);
  for (std::size_t i = 0; i < 120; ++i) At(lowering, i, "LeftArm").rotation = Turn(-0.0125 * double(i), {0, 0, 1});
  for (const Clip& clip : {lowering, AtRest(testing::PersonSkeleton(), 1), AtRest(testing::PersonSkeleton(), 9)}) {
    ASSERT_OK(body, Convert(clip));
    EXPECT_EQ(body->dropped_frames, 0u);
    EXPECT_TRUE(IsTPose(body->motion.poses[0]));
  }
}

TEST(ToBodyMotion, KeepsAFirstFrameThatIsNoTPoseHoweverFarTheNextOneIs) {
  Clip clip = AtRest(testing::PersonSkeleton(), 9, 120);
  LowerArms(clip, 0);
  ASSERT_OK(body, Convert(clip));
  EXPECT_EQ(body->dropped_frames, 0u);
}

TEST(ToBodyMotion, ResamplesByTurningJointsSoThatLimbsKeepTheirLength) {
  // The arm sinks by 80° between two frames at 10 Hz; at 30 Hz its angle must be linear in time.
  Clip clip = AtRest(testing::PersonSkeleton(), 3, 10);
  for (std::size_t i = 0; i < 3; ++i) At(clip, i, "LeftArm").rotation = Turn(Radians(-40.0 * double(i)), {0, 0, 1});
  At(clip, 0, "RightArm").rotation = At(clip, 1, "RightArm").rotation = Turn(1.5, {0, 0, 1});
  ASSERT_OK(body, Convert(clip));
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
    ASSERT_OK(body, Convert(clip));
    EXPECT_EQ(body->motion.poses.size(), static_cast<std::size_t>((frames - 1) / 4 + 1)) << frames;
  }
}

TEST(ToBodyMotion, PutsTheFeetOnTheFloorAndLeavesTheRestOfThePlace) {
  Clip clip = AtRest(testing::PersonSkeleton(), 100);
  for (std::size_t i = 0; i < 100; ++i) At(clip, i, "Hips").translation = {300, 95 + 40, -200};
  At(clip, 50, "Hips").translation.y -= 90;  // one bad frame does not raise the clip
  At(clip, 70, "Hips").translation.y += 60;  // a jump does not lower it
  ASSERT_OK(body, Convert(clip));
  EXPECT_NEAR(body->motion.poses[0][kLeftFoot].y, 0, 1e-12);
  EXPECT_NEAR(body->motion.poses[0][kHipCentre].y, 0.9, 1e-12);
  EXPECT_NEAR(body->motion.poses[70][kLeftFoot].y, 0.6, 1e-12);
  EXPECT_NEAR(body->motion.poses[0][kHipCentre].x, 3, 1e-12);
  EXPECT_NEAR(body->motion.poses[0][kHipCentre].z, -2, 1e-12);
}

TEST(ToBodyMotion, TellsWhichRolesItComposed) {
  Skeleton person = testing::PersonSkeleton();
  person.joints[person.Find("LeftHand_End")].rest.translation = {0, 0, 0};
  ASSERT_OK(body, Convert(AtRest(person)));
  EXPECT_THAT(body->Note(), HasSubstr("; joints that are not in the file, so Etude constructed them: left_hand"));
}

TEST(ToBodyMotion, TakesTheUnitThatIsGiven) {
  ASSERT_OK(body, Convert(AtRest(Scaled(1)), {.metres_per_unit = 0.02}));
  EXPECT_EQ(body->unit, "given");
  EXPECT_THAT(body->Note(), HasSubstr("1 unit = 2 cm (given); with the given unit, the body is 3.48 m tall"));
  EXPECT_NEAR(Stature(body->motion.poses[0]), 2 * 1.60 / 0.92, 1e-12);
}

TEST(ToBodyMotion, GivesToysTheStatureOfAPerson) {
  // A head as high as the rest, and short legs: 1.2 units in all.
  Skeleton toy = Scaled(0.01);
  for (const char* name : {"LeftLeg", "RightLeg", "LeftFoot", "RightFoot"}) {
    toy.joints[toy.Find(name)].rest.translation *= 0.4;
  }
  ASSERT_OK(body, Convert(AtRest(toy)));
  EXPECT_NEAR(Stature(body->motion.poses[0]), 1.70, 1e-12);
  EXPECT_NEAR(body->motion.poses[0][kLeftFoot].y, 0, 1e-12);
  EXPECT_EQ(body->unit, "unknown");
}

TEST(ToBodyMotion, TurnsZUpFilesUprightAndKeepsWhoFacesWhereAndWhatIsLeft) {
  Clip clip = AtRest(testing::PersonSkeleton(), 3);
  const auto expected = Convert(clip);
  // The same in a file with Z up: (x, y, z) becomes (x, −z, y).
  const glm::dquat to_z_up = Turn(kPi / 2, {1, 0, 0});
  clip.skeleton.joints[0].rest = {to_z_up * clip.skeleton.joints[0].rest.translation, to_z_up};
  for (LocalPose& frame : clip.frames) frame[0] = clip.skeleton.joints[0].rest;
  const auto body = Convert(clip);
  ASSERT_TRUE(expected && body) << ToString(body.error());
  EXPECT_EQ(body->up, UpAxis::kZ);
  EXPECT_EQ(expected->up, UpAxis::kY);
  EXPECT_EQ(body->Note(),
            "1 unit = 1 cm (centimetre); turned upright from Z up (the axis along which the body stands at rest)");
  EXPECT_LT(WorstJointDistance(body->motion.poses[2], expected->motion.poses[2]), 1e-12);
  // With another declared axis it lies on its back.
  ASSERT_OK(lying, Convert(clip, {.up = UpAxis::kY}));
  EXPECT_LT(lying->motion.poses[0][kHead].y, 0.2);
}

TEST(WorldFromFile, PutsWhateverTheClipMovesWhereTheBodyIs) {
  // Z up, centimetres, 40 above the floor, after three T-pose frames.
  Clip clip = AtRest(testing::PersonSkeleton(), 9);
  const glm::dquat to_z_up = Turn(kPi / 2, {1, 0, 0});
  clip.skeleton.joints[0].rest = {to_z_up * clip.skeleton.joints[0].rest.translation, to_z_up};
  for (std::size_t i = 0; i < 9; ++i) {
    const double walked = i < 3 ? 0 : 10.0 * double(i);
    clip.frames[i][0] = {clip.skeleton.joints[0].rest.translation + glm::dvec3(walked, 3, 40), to_z_up};
    if (i >= 3) LowerArms(clip, i);
  }
  const auto map = FindJointMap(clip.skeleton, "person.bvh");
  ASSERT_OK(body, ToBodyMotion(clip, *map, "person.bvh"));
  ASSERT_EQ(body->motion.poses.size(), 6u);
  std::vector<GlobalTransform> globals;
  for (std::size_t i = 0; i < 6; ++i) {
    ComputeGlobals(clip.skeleton, clip.frames[body->dropped_frames + i], globals);
    const BodyPose in_file = Evaluate(*map, globals);
    for (const Role role : AllRoles()) {
      const glm::dvec3 in_world(WorldFromFile(*body) * glm::dvec4(in_file[role], 1));
      EXPECT_LT(glm::distance(in_world, body->motion.poses[i][role]), 1e-12) << RoleName(role) << " in frame " << i;
    }
  }
}

TEST(ToBodyMotion, TellsWhereItFoundTheFloor) {
  Clip clip = AtRest(testing::PersonSkeleton(), 2);
  for (LocalPose& frame : clip.frames) frame[0].translation.y += 40;
  ASSERT_OK(body, Convert(clip));
  EXPECT_NEAR(body->floor, 40, 1e-12);
  EXPECT_EQ(body->Note(), "1 unit = 1 cm (centimetre); Etude moved the floor from 40 cm to 0");
  ASSERT_OK(kept, Convert(clip, {.keep_floor = true}));
  EXPECT_EQ(kept->floor, 0);
  EXPECT_NEAR(kept->motion.poses[0][kLeftFoot].y, 0.4, 1e-12);
  EXPECT_EQ(kept->Note(), "1 unit = 1 cm (centimetre)");
}

TEST(FindGround, IsThatOfAllClipsOfAFile) {
  const Clip standing = AtRest(testing::PersonSkeleton(), 100);
  Clip seated = AtRest(testing::PersonSkeleton(), 20), with_another_root = seated;
  for (LocalPose& frame : seated.frames) frame[0].translation.y += 40;
  for (LocalPose& frame : with_another_root.frames) frame[0].translation.y += 200;
  const auto map = FindJointMap(standing.skeleton, "person.bvh");
  const Clip clips[] = {seated, standing, with_another_root};
  ASSERT_OK(ground, FindGround(clips, *map));
  EXPECT_EQ(ground->up, UpAxis::kY);
  EXPECT_NEAR(ground->floor, 0, 1e-12);
  EXPECT_NEAR(ground->stature, Stature(Convert(standing)->motion.poses[0]) * 100, 1e-9);
  const BodyOptions told{.floor = ground->floor};
  const auto lowest = [&](const Clip& clip, const BodyOptions& options) {
    const BodyPose pose = Convert(clip, options)->motion.poses[0];
    double height = pose[kHipCentre].y;
    for (const Role role : {kLeftFoot, kRightFoot, kLeftAnkle, kRightAnkle}) height = std::min(height, pose[role].y);
    return height;
  };
  EXPECT_NEAR(lowest(seated, told), 0.4, 1e-12);
  EXPECT_NEAR(lowest(seated, {}), 0, 1e-12) << "alone it has no other floor";
  EXPECT_NEAR(lowest(with_another_root, told), 0, 1e-12) << "out of its legs' reach";
  EXPECT_FALSE(FindGround({}, *map));
}

TEST(ToBodyMotion, RefusesSwappedSides) {
  Skeleton mirrored = testing::PersonSkeleton();
  for (Joint& joint : mirrored.joints) joint.rest.translation.x *= -1;
  EXPECT_EQ(testing::Refusal(Convert(AtRest(mirrored))),
            "person.bvh: the feet point backwards, so left and right are exchanged, or the axes are left-handed");

  Skeleton mixed = testing::PersonSkeleton();
  for (Joint& joint : mixed.joints) {
    if (joint.name.ends_with("Shoulder")) joint.rest.translation.x *= -1;
    if (joint.name.ends_with("Arm")) joint.rest.translation.x *= -1;
    if (joint.name.ends_with("Hand")) joint.rest.translation.x *= -1;
  }
  EXPECT_EQ(testing::Message(Convert(AtRest(mixed))),
            "the left arm is on the side of the right leg, so left and right are exchanged");
}

Skeleton WithoutToes() {
  Skeleton person = testing::PersonSkeleton();
  for (Joint& joint : person.joints) {
    if (joint.name.ends_with("ToeBase") || joint.name.ends_with("ToeBase_End")) joint.rest.translation = {0, 0, 0};
  }
  return person;
}

TEST(ToBodyMotion, RefusesKneesThatBendBackwardsWhereFeetAreComposed) {
  const Skeleton bare = WithoutToes();
  ASSERT_TRUE(Convert(AtRest(bare))) << "straight legs prove nothing";
  for (const int sign : {1, -1}) {
    Clip crouching = AtRest(bare);
    for (const char* side : {"Left", "Right"}) {
      At(crouching, 0, side + std::string("UpLeg")).rotation = Turn(-0.5 * sign, {1, 0, 0});
      At(crouching, 0, side + std::string("Leg")).rotation = Turn(1.0 * sign, {1, 0, 0});
    }
    const auto body = Convert(crouching);
    ASSERT_EQ(body.has_value(), sign > 0);
    if (sign < 0) {
      EXPECT_THAT(body.error().message, HasSubstr("the knees bend backwards"));
    }
  }
}

TEST(ToBodyMotion, TellsOfKneesThatOverstretchAsDepthSensorsDo) {
  const Skeleton bare = WithoutToes();
  for (const double degrees : {2.0, 10.0, 26.0, 40.0}) {
    for (const int elbows : {1, -1}) {
      Clip clip = AtRest(bare);
      LowerArms(clip, 0);
      for (const char* side : {"Left", "Right"}) {
        At(clip, 0, side + std::string("Leg")).rotation = Turn(-Radians(degrees), {1, 0, 0});
      }
      // Arms hang, and forearms bend forward as people's do.
      At(clip, 0, "LeftForeArm").rotation = Turn(-0.3 * elbows, {0, 1, 0});
      At(clip, 0, "RightForeArm").rotation = Turn(0.3 * elbows, {0, 1, 0});
      const auto body = Convert(clip);
      const bool is_believed = degrees < 3 || (degrees < 35 && elbows > 0);
      ASSERT_EQ(body.has_value(), is_believed) << degrees << " " << elbows;
      if (!is_believed) continue;
      const std::string said = fmt::format("; the knees are overextended by {:.0f}° on average", degrees);
      EXPECT_EQ(body->Note().find(said) != std::string::npos, degrees > 3) << body->Note();
    }
  }
}

TEST(ToBodyMotion, KneesOfABackbendAreNotOverextended) {
  Clip clip = AtRest(testing::PersonSkeleton());
  LowerArms(clip, 0);
  At(clip, 0, "Spine").rotation = Turn(-2.6, {1, 0, 0});
  for (const char* shank : {"LeftLeg", "RightLeg"}) At(clip, 0, shank).rotation = Turn(1, {1, 0, 0});
  const auto body = Convert(clip);
  ASSERT_TRUE(body) << ToString(body.error());
  EXPECT_EQ(body->Note().find("overextended"), std::string::npos) << body->Note();
}

TEST(ToBodyMotion, BelievesArmsBeforeTheBodyAndNoneBehindIt) {
  const Skeleton bare = WithoutToes();
  // Straight arms raised forwards or backwards, and knees overstretched by 40° in a fifth of the frames.
  for (const double raised : {1.2, -1.2}) {
    for (const double degrees : {0.0, 20.0}) {
      Clip clip = AtRest(bare, 10);
      for (int t = 0; t < 10; ++t) {
        At(clip, t, "LeftArm").rotation = Turn(-raised, {0, 1, 0});
        At(clip, t, "RightArm").rotation = Turn(raised, {0, 1, 0});
        const double bent = t % 5 == 0 ? 2 * degrees : degrees;
        for (const char* leg : {"LeftLeg", "RightLeg"}) At(clip, t, leg).rotation = Turn(-Radians(bent), {1, 0, 0});
      }
      const auto body = Convert(clip);
      ASSERT_EQ(body.has_value(), raised > 0) << degrees;
      if (body) continue;
      EXPECT_THAT(body.error().message, HasSubstr("the arms bend and reach backwards"));
    }
  }
}

TEST(ToBodyMotion, UndoesAScaleOnTheHipsThatTheRestPoseHasNot) {
  for (const double scale : {0.01, 0.5, 2.0, 2.5}) {
    Clip clip = AtRest(Scaled(0.01), 3);
    for (LocalPose& frame : clip.frames) frame[0].scale = glm::dvec3(scale);
    ASSERT_OK(body, Convert(clip));
    EXPECT_NEAR(Stature(body->motion.poses[0]), 1.60 / 0.92, 1e-9) << scale;
    EXPECT_THAT(body->Note(),
                HasSubstr(fmt::format("in the frames, the body is {:.3g} times as tall as in the rest pose", scale)));
  }
  Clip alike = AtRest(Scaled(0.01), 3);
  for (LocalPose& frame : alike.frames) frame[0].scale = glm::dvec3(1.05);
  EXPECT_EQ(Convert(alike)->unit, "metre");
}

TEST(ToBodyMotion, TellsOfFramesThatShowAnotherSizeThanTheRestPose) {
  Clip clip = AtRest(Scaled(0.01), 40);
  for (LocalPose& frame : clip.frames) frame[0].scale = glm::dvec3(1.2);
  const BodyOptions whole{.drop_t_pose = false};
  const auto larger = Convert(clip, whole);
  EXPECT_EQ(larger->unit, "metre");
  EXPECT_THAT(larger->Note(), HasSubstr("in the frames, the body is 1.2 times as tall as in the rest pose"));
  for (std::size_t f = 0; f < 30; ++f) clip.frames[f][0].scale = glm::dvec3(1);
  EXPECT_THAT(Convert(clip, whole)->Note(), ::testing::Not(HasSubstr("times")))
      << "one that is squashed in a few frames";
  for (std::size_t f = 30; f < 40; ++f) clip.frames[f][0].scale = glm::dvec3(2);
  EXPECT_THAT(Convert(clip, whole)->Note(), HasSubstr("the size of the body changes between frames by a factor of 2"));
}

TEST(ToBodyMotion, KeepsTheUnitOfItsFileWhereOneClipStretchesTheBody) {
  const Clip standing = AtRest(Scaled(0.01), 20);
  Clip stretched = AtRest(Scaled(0.01), 5);
  for (LocalPose& frame : stretched.frames) frame[0].scale = glm::dvec3(1.5);
  const auto map = FindJointMap(standing.skeleton, "person.glb");
  const Clip clips[] = {stretched, standing};
  const BodyOptions told{.stature = FindGround(clips, *map)->stature};
  EXPECT_EQ(Convert(standing, told)->Note(), Convert(standing)->Note());
  const auto body = Convert(stretched, told);
  EXPECT_EQ(body->metres_per_unit, 1);
  EXPECT_THAT(body->Note(),
              HasSubstr("in this clip, the body is 1.5 times as tall as in the median frame of the file"));
  EXPECT_NE(Convert(stretched)->metres_per_unit, 1) << "alone it has no other measure";
}

TEST(ToBodyMotion, RefusesAUnitUnderWhichTheBodyIsNone) {
  EXPECT_EQ(testing::Message(Convert(AtRest(Scaled(0.01)), {.metres_per_unit = 0.01})),
            "with the given unit (1 unit = 1 cm), the body is 0.0174 m tall; allowed: 0.4 to 4 m; with 1 unit = 100 cm "
            "(metre), the body would be 1.74 m tall");
  EXPECT_FALSE(Convert(AtRest(Scaled(1)), {.metres_per_unit = 1}));
  ASSERT_OK(child, Convert(AtRest(Scaled(1)), {.metres_per_unit = 0.0055}));
  EXPECT_THAT(child->Note(),
              HasSubstr("with the given unit, the body is 0.96 m tall; with 1 unit = 1 cm (centimetre), the body would "
                        "be 1.74 m tall"));
  EXPECT_EQ(Convert(AtRest(Scaled(1)), {.metres_per_unit = 0.01})->Note(), "1 unit = 1 cm (given)");
}

TEST(ToBodyMotion, UnderstandsPushUps) {
  Clip clip = AtRest(testing::PersonSkeleton(), 5);
  for (LocalPose& frame : clip.frames) frame[0].rotation = Turn(Radians(80), {1, 0, 0});
  ASSERT_OK(body, Convert(clip));
  EXPECT_EQ(body->up, UpAxis::kY);
  EXPECT_THAT(body->Note(), HasSubstr("the body lies along Z, and Etude assumes that Y is up"));
  EXPECT_THAT(body->Note(), Not(HasSubstr("rotate the file first")));
}

TEST(ToBodyMotion, SaysThatABodyIsUpsideDown) {
  Clip clip = AtRest(testing::PersonSkeleton(), 5);
  for (LocalPose& frame : clip.frames) frame[0].rotation = Turn(Radians(180), {1, 0, 0});
  EXPECT_THAT(Convert(clip)->doubts, ::testing::Contains("the body is upside down, and Etude assumes that Y is up"));
}

TEST(ToBodyMotion, TellsThatABodyLiesWhoseUpAxisNobodyKnows) {
  for (const auto& [turn, axis] :
       {std::pair(Turn(Radians(-90), {0, 0, 1}), "X"), std::pair(Turn(Radians(-90), {1, 0, 0}), "−Z")}) {
    Skeleton lying = testing::PersonSkeleton();
    for (Joint& joint : lying.joints) joint.rest.translation = turn * joint.rest.translation;
    ASSERT_OK(body, Convert(AtRest(lying)));
    EXPECT_THAT(body->Note(),
                HasSubstr(std::string("the body lies along ") + axis +
                          ", also at rest, and Etude assumes that Y is up; if another axis is up, rotate the file "
                          "first"));
  }
}

TEST(ToBodyMotion, RefusesASkeletonThatCollapsesInMotion) {
  Clip clip = AtRest(testing::PersonSkeleton(), 3);
  for (std::size_t f = 0; f < 3; ++f) {
    for (const char* joint : {"LeftForeArm", "RightForeArm", "LeftLeg", "RightLeg"}) At(clip, f, joint).translation = {};
  }
  EXPECT_THAT(testing::Message(Convert(clip)),
              HasSubstr("4 of the body's 8 limbs have no length (left_shoulder to left_elbow"));
  // The control: one limb may be missing.
  for (std::size_t f = 0; f < 3; ++f) {
    At(clip, f, "RightForeArm").translation = {-29, 0, 0};
    At(clip, f, "LeftLeg").translation = At(clip, f, "RightLeg").translation = {0, -43, 0};
  }
  EXPECT_TRUE(Convert(clip)) << ToString(Convert(clip).error());
}

TEST(ToBodyMotion, SaysEveryChangeByItself) {
  Clip clip = AtRest(testing::PersonSkeleton(), 120, 60);
  for (LocalPose& frame : clip.frames) frame[0].translation.y += 17.5;
  ASSERT_OK(body, Convert(clip));
  EXPECT_THAT(body->changes, ::testing::ElementsAre("1 unit = 1 cm (centimetre)", "resampled from 60 to 30 Hz",
                                                    "Etude moved the floor from 17.5 cm to 0"));
}

TEST(ToBodyMotion, TakesTheFormatsAxisBeforePostureAndTheUsersBeforeBoth) {
  // A person lying on the back along Y in a format with Z up; posture alone would make this person stand.
  Clip lying = AtRest(testing::PersonSkeleton(), 5);
  ASSERT_OK(of_format, Convert(lying, {.up_rule = AmassUp()}));
  EXPECT_EQ(of_format->found_up.evidence, UpEvidence::kFormat);
  EXPECT_LT(of_format->motion.poses[0][kHead].y, 0.3);
  EXPECT_THAT(of_format->Note(),
              HasSubstr("the body stands along Y, but Z is the convention of AMASS; --up sets another axis"));
  ASSERT_OK(told, Convert(lying, {.up = UpAxis::kY, .up_rule = AmassUp()}));
  EXPECT_EQ(told->found_up.evidence, UpEvidence::kTold);
  EXPECT_GT(told->motion.poses[0][kHead].y, 1.6);
}

/// Walks along +Z on stiff legs: the standing foot stays in place.
Clip StiffWalk(double root_factor) {
  constexpr double kLeg = 85, kStep = 0.35;  // centimetres; radians to either side
  constexpr std::size_t kFrames = 15;        // frames of a step
  Clip clip = AtRest(testing::PersonSkeleton(), 90);
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    LowerArms(clip, f);
    const double part = static_cast<double>(f % kFrames) / kFrames;
    const double lean = std::asin(std::sin(kStep) * (2 * part - 1));  // backward lean of the standing leg
    const bool is_left = f / kFrames % 2 == 0;
    At(clip, f, is_left ? "LeftUpLeg" : "RightUpLeg").rotation = Turn(lean, {1, 0, 0});
    At(clip, f, is_left ? "RightUpLeg" : "LeftUpLeg").rotation = Turn(-lean, {1, 0, 0});
    const double way = 2 * std::sin(kStep) * kLeg * (static_cast<double>(f / kFrames) + part);
    At(clip, f, "Hips").translation = root_factor * glm::dvec3(0, 95 - kLeg * (1 - std::cos(lean)), way);
  }
  return clip;
}

TEST(ToBodyMotion, SaysThatTheRootTravelsInAnotherUnit) {
  EXPECT_THAT(Convert(StiffWalk(1))->doubts, ::testing::IsEmpty());
  for (const auto& [factor, said] :
       {std::pair(0.01, "100;"), {1 / 2.54, "2.54;"}, {1 / 17.72, "17.72;"}, {1 / 5.644, "5.644;"}, {100.0, "0.01;"}}) {
    ASSERT_OK(body, Convert(StiffWalk(factor)));
    EXPECT_THAT(body->doubts,
                ::testing::ElementsAre(HasSubstr(fmt::format("the root's positions were multiplied by {}", said))));
  }
  // A gliding statue is no reason for doubt, except at a hundred metres a second.
  Clip glides = AtRest(testing::PersonSkeleton(), 60);
  for (std::size_t f = 0; f < 60; ++f) At(glides, f, "Hips").translation.z = 5.0 * static_cast<double>(f);
  EXPECT_THAT(Convert(glides)->doubts, ::testing::IsEmpty());
  for (std::size_t f = 0; f < 60; ++f) At(glides, f, "Hips").translation.z *= 100;
  EXPECT_THAT(Convert(glides)->doubts, ::testing::ElementsAre(HasSubstr("have a smaller unit than the limbs")));
}

TEST(ToBodyMotion, DoubtsRatesThatShowNoFastMotion) {
  for (const double rate : {2.0, 7.5})
    EXPECT_THAT(Convert(AtRest(testing::PersonSkeleton(), 9, rate))->doubts,
                ::testing::Contains(::testing::StartsWith(fmt::format("at {:.3g} Hz, the frames are too far", rate))));
  EXPECT_THAT(Convert(AtRest(testing::PersonSkeleton(), 9, 10))->doubts, ::testing::IsEmpty());
}

TEST(ToBodyMotion, SaysAnImpossibleHeightAndNoChangeOfRateThatReadsAlike) {
  EXPECT_EQ(DescribeResampling(30.00003, 30), "");
  EXPECT_EQ(DescribeResampling(29.97, 30), "resampled from 29.97 to 30 Hz");
  EXPECT_THAT(Convert(AtRest(testing::PersonSkeleton(), 3, 30.00003))->Note(), Not(HasSubstr("resampled")));
  for (const auto& [unit, is_said] :
       {std::pair(0.01, false), {0.0025, true}, {0.0029, true}, {0.0052, false}, {0.018, true}}) {
    ASSERT_OK(body, Convert(AtRest(testing::PersonSkeleton()), {.metres_per_unit = unit}));
    EXPECT_EQ(body->Note().find("; is the file's unit right?") != std::string::npos, is_said) << unit;
    EXPECT_EQ(body->doubts.empty(), !is_said) << unit;
  }
  // A child of a year is as small as an adult in a wrong unit may seem, but its legs are shorter.
  BodyPose adult = testing::BodyAtRest(testing::PersonSkeleton(), *FindJointMap(testing::PersonSkeleton(), "a.bvh"));
  for (glm::dvec3& joint : adult.joints) joint *= .004;
  EXPECT_THAT(DescribeImpossibleHeight({&adult, 1}), HasSubstr("the legs have an adult's proportion of the height"));
  BodyPose child = adult;
  for (const Role role : {Role::kLeftKnee, Role::kLeftAnkle, Role::kRightKnee, Role::kRightAnkle}) {
    const bool is_left = role == Role::kLeftKnee || role == Role::kLeftAnkle;
    const glm::dvec3 hip = adult[is_left ? Role::kLeftHip : Role::kRightHip];
    child[role] = hip + .7 * (adult[role] - hip);
  }
  EXPECT_EQ(DescribeImpossibleHeight({&child, 1}), "");
}

TEST(ToBodyMotion, RefusesWhatGivesNoMotion) {
  EXPECT_THAT(testing::Message(Convert(AtRest(testing::PersonSkeleton(), 0))), HasSubstr("no frames"));

  EXPECT_THAT(testing::Message(Convert(AtRest(Scaled(1e-12)))), HasSubstr("allowed: joints at different positions"));

  EXPECT_EQ(testing::Message(Convert(AtRest(testing::PersonSkeleton(), 400, 1), {.rate_hz = 1e6})),
            "399 s at 1e+06 Hz are too many poses; allowed: at most 500000 poses");

  Clip flying = AtRest(testing::PersonSkeleton(), 2);
  At(flying, 1, "Hips").translation.x = 1e300;
  EXPECT_THAT(testing::Message(Convert(flying)), HasSubstr("too far away from the origin"));
  Clip later = AtRest(testing::PersonSkeleton(), 9, 30);
  for (std::size_t i = 3; i < 9; ++i) LowerArms(later, i);
  At(later, 7, "Hips").translation.x = 1e300;
  EXPECT_EQ(testing::Message(Convert(later)), "in frame 7 joints are too far away from the origin")
      << "the T-pose's frames count";

  EXPECT_EQ(testing::Message(Convert(AtRest(testing::PersonSkeleton(), 400, 0.1))),
            "the clip lasts 3990 s; allowed: at most 3600 s; frames are 10 s apart: are the times in milliseconds?");
}

}  // namespace
}  // namespace etude
