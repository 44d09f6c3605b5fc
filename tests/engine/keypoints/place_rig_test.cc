#include "engine/keypoints/place_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/base/angles.h"
#include "engine/cameras/camera.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Returns a person of 1.7 m who stands at several places on the floor (height 0), two seconds each, facing +z and
/// leaning forwards, mapped into the file's world.
template <class Map>
std::vector<LandmarkPositions> Stander(const Map& to_file, double lean_deg = 0) {
  using enum Landmark;
  std::vector<LandmarkPositions> frames;
  const double lean = Radians(lean_deg);
  for (int k = 0; k < 120; ++k) {
    LandmarkPositions places;
    const double angle = 0.5 * (k / 20);  // steps to the next place, then rests
    const glm::dvec3 at(0.8 * std::cos(3 * angle), 0, 0.6 * std::sin(2 * angle));
    const auto set = [&](Landmark landmark, double x, double y, double z) {
      places[Index(landmark)] = to_file(at + glm::dvec3(x, y, z));
    };
    for (const double side : {1.0, -1.0}) {
      const bool left = side > 0;
      const double x = 0.1 * side, ankle = 0.08;
      set(left ? kLeftAnkle : kRightAnkle, x, ankle, 0);
      set(left ? kLeftHeel : kRightHeel, x, 0.03, -0.05);
      set(left ? kLeftBigToe : kRightBigToe, x, 0.02, 0.15);
      set(left ? kLeftSmallToe : kRightSmallToe, 1.3 * x, 0.02, 0.13);
      const auto above = [&](double along) {
        return std::pair(ankle + along * std::cos(lean), along * std::sin(lean));
      };
      set(left ? kLeftKnee : kRightKnee, x, above(0.42).first, above(0.42).second);
      set(left ? kLeftHip : kRightHip, x, above(0.85).first, above(0.85).second);
      set(left ? kLeftShoulder : kRightShoulder, 1.8 * x, above(1.3).first, above(1.3).second);
    }
    frames.push_back(places);
  }
  return frames;
}

RigFile SomeRig() {
  RigFile rig;
  rig.cameras.push_back({"left", LookAt({}, {1, 2, 3}, {0, 1, 0})});
  rig.format = "Pose2Sim";
  return rig;
}

glm::dmat3 TurnAboutX(double degrees) { return glm::mat3_cast(glm::angleAxis(Radians(degrees), glm::dvec3(1, 0, 0))); }

constexpr double kPlaceRate = 30;

TEST(PlaceRig, LeavesARigAsItIsWhoseUnitAndAxesFitThePerson) {
  ASSERT_OK(place, PlaceRig(SomeRig(), Stander([](glm::dvec3 p) { return p; }, 5), kPlaceRate, {}));
  EXPECT_TRUE(place->IsNone());
  EXPECT_NEAR(place->stature_m, 1.7, 1e-9);
  EXPECT_EQ(
      place->told,
      "lengths in m (legs of 0.85 m from hip to ankle); up is y (the person leans 5° from this axis); the floor is as "
      "in the file");
}

TEST(PlaceRig, FindsTheUnitThatMakesItAPerson) {
  for (const auto& [name, metres] : {std::pair("cm", 0.01), {"mm", 0.001}, {"inch", 0.0254}, {"foot", 0.3048}}) {
    ASSERT_OK(place, PlaceRig(SomeRig(), Stander([m = metres](glm::dvec3 p) { return p / m; }), kPlaceRate, {}))
        << name;
    EXPECT_DOUBLE_EQ(place->scale, metres) << name;
    EXPECT_NEAR(place->stature_m, 1.7, 1e-9) << name;
    EXPECT_THAT(place->told, HasSubstr(std::string("lengths in ") + name +
                                       " (this unit gives legs of 0.85 m from hip to ankle; in m the legs would be "));
  }
  const auto child = PlaceRig(SomeRig(), Stander([](glm::dvec3 p) { return p * 350.0; }), kPlaceRate, {});
  EXPECT_DOUBLE_EQ(child.value().scale, 0.001) << "0.6 m tall: nobody else's unit makes that";
  EXPECT_THAT(
      testing::Message(PlaceRig(SomeRig(), Stander([](glm::dvec3 p) { return p * 1e5; }), kPlaceRate, {})),
      HasSubstr("the legs are 8.5e+04 units long from hip to ankle, which is impossible for a person in each of the "
                "units m, cm, mm, inch, foot; for a person of 1.7 m, use about --rig-unit 1e-05"));
}

TEST(PlaceRig, TakesTheUnitThatIsToldAndNoOtherPersonThanOne) {
  RigFile rig = SomeRig();
  rig.has_unit = false;
  const auto points = Stander([](glm::dvec3 p) { return p * 4.0; });
  EXPECT_THAT(testing::Message(PlaceRig(rig, points, kPlaceRate, {})),
              HasSubstr("for a person of 1.7 m, the unit is about 0.25 m"));
  ASSERT_OK(told, PlaceRig(rig, points, kPlaceRate, {.unit = "0.3"}));
  EXPECT_DOUBLE_EQ(told->scale, 0.3);
  EXPECT_THAT(told->told, HasSubstr("lengths in units of 0.3 m (as given; legs of 1.02 m from hip to ankle)"));
  for (const char* unit : {"mm", "0.4"}) {
    EXPECT_THAT(testing::Message(PlaceRig(rig, points, kPlaceRate, {.unit = unit})),
                HasSubstr("allowed: 0.25 to 1.1 m; for a person of 1.7 m, use about --rig-unit 0.25"))
        << unit;
  }
  // If a person's legs are 12 % short, the message suggests the correct unit, and not a scale that lengthens the legs.
  const auto shorter = Stander([](glm::dvec3 p) { return 0.88 * p; });
  EXPECT_EQ(testing::Message(PlaceRig(SomeRig(), shorter, kPlaceRate, {.unit = "mm"})),
            "with lengths in mm, the person would have legs of 0.000748 m from hip to ankle; allowed: 0.25 to 1.1 m; "
            "--rig-unit m gives legs of 0.748 m");
}

TEST(PlaceRig, FindsTheAxisThatIsUpAndTheFloorUnderTheFeet) {
  // The file's world is ours, turned and raised by half a unit: the turn and the floor must be found.
  for (const auto& [turn, name] : {std::pair(90.0, "z"), {-90.0, "-z"}, {180.0, "-y"}}) {
    const glm::dmat3 R = TurnAboutX(turn);
    const auto place =
        PlaceRig(SomeRig(), Stander([&](glm::dvec3 p) { return R * (p + glm::dvec3(0, 0.5, 0)); }, 6), kPlaceRate, {});
    ASSERT_TRUE(place) << name;
    EXPECT_THAT(place->told, HasSubstr(std::string("up is ") + name + " (found: resting feet)"));
    EXPECT_THAT(place->told, HasSubstr("the floor is under the feet"));
    const glm::dvec3 floor = (*place)(R * glm::dvec3(0.3, 0.5, 0.2)), above = (*place)(R * glm::dvec3(0.3, 1.5, 0.2));
    EXPECT_NEAR(floor.y, 0, 1e-9) << name;
    EXPECT_LT(glm::distance(above - floor, glm::dvec3(0, 1, 0)), 1e-9) << name;
  }
}

TEST(PlaceRig, PutsAWorldThatIsACamerasFrameSquareToTheFloorOfTheFeet) {
  const Camera first = LookAt({}, {0.5, 1.5, 4}, {0, 0.6, 0});
  RigFile rig = SomeRig();
  rig.cameras[0] = {"cam1", Camera{}};
  const auto to_camera = [&](glm::dvec3 p) { return first.R_CW * (p - first.p_WC); };
  for (const double lean_deg : {0.0, 8.0}) {
    ASSERT_OK(place, PlaceRig(rig, Stander(to_camera, lean_deg), kPlaceRate, {}));
    EXPECT_THAT(place->told, HasSubstr("the up direction is found from resting feet, to within 1."));
    EXPECT_THAT(place->told, HasSubstr("(the world frame was that of camera cam1)"));
    for (const glm::dvec3 p : {glm::dvec3(0), glm::dvec3(0.8, 0, 0.6), glm::dvec3(0, 1.7, 0)}) {
      EXPECT_NEAR((*place)(to_camera(p)).y, p.y, 0.003) << lean_deg;
    }
  }
}

TEST(PlaceRig, TellsOfAFloorThatIsOffLevelAndLevelsItWhenAsked) {
  const auto tilted = Stander([](glm::dvec3 p) { return TurnAboutX(12) * p; });
  ASSERT_OK(kept, PlaceRig(SomeRig(), tilted, kPlaceRate, {}));
  EXPECT_TRUE(kept->IsNone());
  EXPECT_THAT(kept->told,
              HasSubstr("; according to resting feet, the up direction is 12° away from this axis; if the up direction "
                        "is right, use --rig-up floor"));
  ASSERT_OK(level, PlaceRig(SomeRig(), tilted, kPlaceRate, {.up = "floor"}));
  const glm::dvec3 up = level->R * TurnAboutX(12) * glm::dvec3(0, 1, 0);
  EXPECT_GT(up.y, std::cos(Radians(0.1)));
  RigFile boards = SomeRig();
  boards.format = "Caliscope";
  EXPECT_FALSE(PlaceRig(boards, tilted, kPlaceRate, {})->IsNone()) << "its axes are some board's";
}

TEST(PlaceRig, RefusesAPersonUpsideDownAndFramesWithoutOne) {
  const auto points = Stander([](glm::dvec3 p) { return p; });
  const auto down = PlaceRig(SomeRig(), points, kPlaceRate, {.up = "-y"});
  ASSERT_FALSE(down);
  EXPECT_THAT(down.error().message, HasSubstr("with -y up, everything would be upside down: this axis is 180° away "
                                              "from the up direction found from "));
  ASSERT_OK(side, PlaceRig(SomeRig(), points, kPlaceRate, {.up = "x"})) << "lying is allowed";
  EXPECT_LT(glm::distance(side->R * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)), 1e-12);
  EXPECT_NEAR(glm::determinant(side->R), 1, 1e-12);
  const auto nobody = PlaceRig(SomeRig(), std::vector<LandmarkPositions>(5), kPlaceRate, {});
  EXPECT_THAT(testing::Message(nobody), HasSubstr("no frame shows hips, knees, ankles and shoulders"));
  EXPECT_EQ(nobody.error().place.file, "keypoints") << "not the rig's fault";
}

TEST(PlaceRig, PutsTheFloorWhereItIsAskedFor) {
  const auto raised = Stander([](glm::dvec3 p) { return p + glm::dvec3(0, 0.3, 0); });
  for (const auto& [floor, shift] : {std::pair("auto", 0.0), {"keep", 0.0}, {"feet", -0.3}, {"1.25", -1.25}}) {
    ASSERT_OK(place, PlaceRig(SomeRig(), raised, kPlaceRate, {.floor = floor})) << floor;
    EXPECT_NEAR(place->shift.y, shift, 1e-9) << floor;
  }
  const auto in_mm = Stander([](glm::dvec3 p) { return 1000.0 * (p + glm::dvec3(0, 0.3, 0)); });
  EXPECT_NEAR(PlaceRig(SomeRig(), in_mm, kPlaceRate, {.floor = "feet"})->shift.y, -0.3, 1e-9);
}

TEST(PlaceRig, WithoutAPersonTakesWhatIsTold) {
  RigFile rig = SomeRig();
  EXPECT_TRUE(PlaceRig(rig, {})->IsNone());
  ASSERT_OK(place, PlaceRig(rig, {.unit = "mm", .up = "z", .floor = "0.2"}));
  EXPECT_LT(glm::distance((*place)({0, 0, 1000}), glm::dvec3(0, 0.8, 0)), 1e-12);
  rig.unit_m = 0.01;
  EXPECT_DOUBLE_EQ(PlaceRig(rig, {.unit = "mm"})->scale, 0.1);
  EXPECT_THAT(PlaceRig(rig, {.up = "floor"}).error().message,
              HasSubstr("the rig does not show which direction is up; use --rig-up to set the file's up axis"));
  rig.cameras.push_back({"eye", Camera{}});
  EXPECT_THAT(PlaceRig(rig, {}).error().message, HasSubstr("the rig does not show which direction is up, because the "
                                                           "world frame is that of camera eye"));
  rig.has_unit = false;
  EXPECT_THAT(PlaceRig(rig, {.up = "y"}).error().message,
              HasSubstr("a calibration of the format Pose2Sim has no unit of length"));
  EXPECT_TRUE(PlaceRig(rig, {.unit = "inch", .up = "y"}));
}

TEST(PlaceRig, TellsWhichAxesOfTheFileAreOurs) {
  RigFile rig = SomeRig();
  rig.R_WF = glm::dmat3(0, 0, 1, 1, 0, 0, 0, 1, 0);  // (x, y, z) of the file is our (y, z, x)
  EXPECT_EQ(PlaceRig(rig, {})->told,
            "lengths in m; up is z, as in the format; Etude's x is the file's y, Etude's z is "
            "the file's x, and up is the file's z");
  EXPECT_EQ(PlaceRig(rig, {.unit = "mm", .up = "-y", .floor = "0.2"})->told,
            "lengths in mm; up is -y (as given); the floor is at height 0.2 m; Etude's x is the file's z, Etude's z is "
            "the file's x, and up is the file's -y");
  EXPECT_EQ(PlaceRig(SomeRig(), {})->told, "lengths in m; up is y, as in the format") << "the axes are the same";
  ASSERT_OK(seen, PlaceRig(rig, Stander([](glm::dvec3 p) { return p; }), kPlaceRate, {}));
  EXPECT_THAT(seen->told,
              ::testing::EndsWith("the floor is as in the file; Etude's x is the file's y, Etude's z is the "
                                  "file's x, and up is the file's z"));
}

/// Returns four cameras around a person, 1 to 3 m high, in a file whose axes are `R_FW` times ours, but whose format
/// has our axes.
RigFile RigOnItsSide(const glm::dmat3& R_FW) {
  RigFile rig;
  rig.format = "OpenCV's YAML";
  for (const glm::dvec3& p : {glm::dvec3(-3, 2.2, 3.5), {3, 1.5, 3.2}, {3.2, 2.4, -3}, {-2.8, 1.2, -3.4}}) {
    Camera camera = LookAt({}, p, {0, 1, 0});
    camera.R_CW = camera.R_CW * glm::transpose(R_FW);
    camera.p_WC = R_FW * camera.p_WC;
    rig.cameras.push_back({"c" + std::to_string(rig.cameras.size() + 1), camera});
  }
  return rig;
}

// A forecast (without a person) and a capture (with one) of one rig file must agree about the up axis.
TEST(PlaceRig, FindsTheSameAxisWithAndWithoutAPerson) {
  const glm::dmat3 z_up(0, 1, 0, 0, 0, 1, 1, 0, 0), x_up(0, 0, 1, 1, 0, 0, 0, 1, 0);
  for (const auto& [R_FW, told] : {std::pair(glm::dmat3(1), "up is y, as in the format"),
                                   {z_up, "up is z (found: the cameras' horizons)"},
                                   {x_up, "up is x (found: the cameras' horizons)"},
                                   {TurnAboutX(180), "up is -y (found: the cameras' horizons)"}}) {
    const RigFile rig = RigOnItsSide(R_FW);
    ASSERT_OK(alone, PlaceRig(rig, {}));
    EXPECT_THAT(alone->told, HasSubstr(told));
    EXPECT_EQ(alone->doubt, "");
    ASSERT_OK(seen, PlaceRig(rig, Stander([&](glm::dvec3 p) { return R_FW * p; }), kPlaceRate, {}));
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(glm::distance(alone->R[axis], seen->R[axis]), 1e-9) << told;
    EXPECT_EQ(seen->doubt, "");
  }
}

TEST(PlaceRig, KeepsTheFormatsAxisForCamerasThatLookDown) {
  RigFile rig = RigOnItsSide(glm::dmat3(1));
  // The columns are the world's axes in the camera: x is right, y is behind, z is down in the picture.
  for (NamedCamera& named : rig.cameras) named.camera.R_CW = glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0);
  EXPECT_NEAR(glm::transpose(rig.cameras.front().camera.R_CW)[2].y, -1, 1e-12);
  EXPECT_EQ(PlaceRig(rig, {})->told, "lengths in m; up is y, as in the format");
}

TEST(PlaceRig, NamesCamerasBelowTheFloor) {
  RigFile rig = RigOnItsSide(glm::dmat3(1));
  EXPECT_THAT(PlaceRig(rig, {.floor = "1.35"})->doubt, HasSubstr("floor: c4 by 0.15 m;"));
  rig.cameras[1].camera.p_WC.y = -0.05;
  EXPECT_EQ(PlaceRig(rig, {})->doubt, "") << "within the error of a calibration";
  rig.cameras[1].camera.p_WC.y = -0.84;
  const std::string said =
      "cameras are below the floor: c2 by 0.84 m; use --rig-up to set the rig's up axis, and --floor to set the height "
      "of the floor";
  EXPECT_EQ(PlaceRig(rig, {})->doubt, said);
  EXPECT_EQ(PlaceRig(rig, Stander([](glm::dvec3 p) { return p; }), kPlaceRate, {})->doubt, said);
  EXPECT_THAT(PlaceRig(RigOnItsSide(glm::dmat3(1)), {.up = "-y"})->doubt, HasSubstr("c1 by 2.20 m, c2 by 1.50 m"));
}

TEST(PlaceRig, RefusesDistancesThatNoRigHas) {
  const auto apart = [](double metres) {
    RigFile rig = SomeRig();
    rig.cameras.push_back(rig.cameras.front());
    rig.cameras[1].camera.p_WC.x += metres;
    return rig;
  };
  for (const double metres : {0.0, 0.05, 4.0, 90.0}) EXPECT_TRUE(PlaceRig(apart(metres), {})) << metres;
  EXPECT_EQ(PlaceRig(apart(6122), {}).error().message,
            "with lengths in m, the rig's cameras are 6122 m apart; allowed: 0.03 to 100 m; use --rig-unit to set the "
            "unit: 6.12 m apart with mm");
  EXPECT_THAT(PlaceRig(apart(400), {}).error().message,
              HasSubstr("--rig-unit to set the unit: 4 m apart with cm, 10.2 m apart with inch"));
  EXPECT_THAT(PlaceRig(apart(0.004), {}).error().message, ::testing::EndsWith("use --rig-unit to set the unit"));
  EXPECT_TRUE(PlaceRig(apart(6122), {.unit = "m"})) << "who gives the unit is believed";
}

TEST(PlaceRig, RefusesWordsThatMeanNothing) {
  EXPECT_TRUE(CheckPlace({.unit = "0.0254", .up = "-x", .floor = "-1.5"}));
  for (const char* unit : {"metre", "0", "-1", "1m", "inf", ""}) {
    EXPECT_THAT(testing::Message(CheckPlace({.unit = unit})),
                HasSubstr("allowed: auto, m, cm, mm, inch, foot, or the metres in one unit"))
        << unit;
  }
  EXPECT_THAT(CheckPlace({.up = "w"}).error().message, HasSubstr("allowed: auto, floor, x, y, z, -x, -y, -z"));
  EXPECT_THAT(CheckPlace({.floor = "low"}).error().message,
              HasSubstr("allowed: auto, keep, feet, or the height of the floor"));
}

TEST(Placed, CamerasShowPlacedPointsWhereTheyShowedThemBefore) {
  const Camera camera = LookAt({}, {1, 2, 3}, {0, 1, 0});
  RigPlacement place{.scale = 0.3048, .R = TurnAboutX(70), .shift = {0.1, -0.4, 0.2}};
  const Camera placed = Placed(place, camera);
  for (const glm::dvec3 p : {glm::dvec3(0, 1, 0), glm::dvec3(0.4, 1.3, 0.5), glm::dvec3(-0.6, 0.2, -1)}) {
    EXPECT_LT(glm::distance(*Project(placed, place(p)), *Project(camera, p)), 1e-9);
  }
}

}  // namespace
}  // namespace etude
