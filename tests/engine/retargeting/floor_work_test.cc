#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "engine/retargeting/up_axis.h"
#include "tests/engine/retargeting/standing_person.h"

namespace etude::floor_work {
namespace {

using enum Role;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kRate_hz = 50;

BodyPose Moved(BodyPose pose, const std::function<glm::dvec3(const glm::dvec3&)>& place) {
  for (glm::dvec3& joint : pose.joints) joint = place(joint);
  return pose;
}

/// Rotates about X, forwards: a standing person then lies face down with the head towards +Z.
glm::dvec3 Bowed(const glm::dvec3& p, double degrees) {
  const double angle = degrees * 3.14159265 / 180, c = std::cos(angle), s = std::sin(angle);
  return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

BodyPose Crawling(double time_s) {
  BodyPose pose = testing::StandingPerson();
  pose[kHipCentre] = {0, .47, 0};
  pose[kSpine] = {0, .5, .25};
  pose[kShoulderCentre] = {0, .5, .5};
  pose[kHead] = {0, .6, .68};
  for (const double side : {1.0, -1.0}) {
    const double swing = .1 * side * std::sin(6 * time_s);
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    pose[of(kLeftShoulder)] = {side * .18, .5, .48};
    pose[of(kLeftElbow)] = {side * .18, .28, .5 + swing};
    pose[of(kLeftWrist)] = {side * .18, .06, .55 + swing};
    pose[of(kLeftHand)] = {side * .18, .03, .7 + swing};
    pose[of(kLeftHip)] = {side * .09, .47, 0};
    pose[of(kLeftKnee)] = {side * .09, .05, -swing};
    pose[of(kLeftAnkle)] = {side * .09, .06, -.42 - swing};
    pose[of(kLeftFoot)] = {side * .09, .02, -.55 - swing};
  }
  return Moved(pose, [&](const glm::dvec3& p) { return p + glm::dvec3(0, 0, .5 * time_s); });
}

BodyPose PushingUp(double time_s) {
  BodyPose pose = testing::StandingPerson();
  const double rise = 13 + 6 * std::sin(3 * time_s);  // degrees
  pose = Moved(
      pose, [&](const glm::dvec3& p) { return Bowed(p - glm::dvec3(0, .02, .17), 90 - rise) + glm::dvec3(0, .03, 0); });
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    pose[of(kLeftWrist)] = {side * .25, .05, 1.3};
    pose[of(kLeftHand)] = {side * .25, .03, 1.4};
    pose[of(kLeftElbow)] = .5 * (pose[of(kLeftWrist)] + pose[of(kLeftShoulder)]) + glm::dvec3(side * .1, 0, -.1);
  }
  return pose;
}

BodyPose Swimming(double time_s) {
  return Moved(testing::StandingPerson(),
               [&](const glm::dvec3& p) { return Bowed(p, 90) + glm::dvec3(0, .9, 1.2 * time_s); });
}

/// A cartwheel along +Z, turning about X.
BodyPose Wheeling(double time_s) {
  return Moved(testing::StandingPerson(), [&](const glm::dvec3& p) {
    return Bowed(p - glm::dvec3(0, .9, 0), 120 * time_s) + glm::dvec3(0, .95, time_s);
  });
}

/// Lies on the back, two metres from the origin.
BodyPose LyingAway(double time_s) {
  BodyPose pose = testing::StandingPerson();
  pose = Moved(pose, [&](const glm::dvec3& p) { return Bowed(p, -90) + glm::dvec3(0, .1, 2); });
  pose[kLeftWrist].y += .1 * (1 + std::sin(3 * time_s));
  return pose;
}

/// Lies stretched out on the back, in the pose of a person who stands straight, and hardly moves.
BodyPose LyingStraight(double time_s) {
  return Moved(testing::StandingPerson(),
               [&](const glm::dvec3& p) { return Bowed(p, -90) + glm::dvec3(0, .03 + .001 * std::sin(time_s), 0); });
}

/// Lies on a bed; only the arms move.
BodyPose LyingInBed(double time_s) {
  return Moved(LyingAway(time_s), [](const glm::dvec3& p) { return p + glm::dvec3(.4, .55, -2.3); });
}

/// Lies on a bench with the feet on the floor.
BodyPose PressingOnABench(double time_s) {
  BodyPose pose = LyingAway(time_s);
  pose = Moved(pose, [](const glm::dvec3& p) { return p + glm::dvec3(0, .4, 1.1 - 2); });
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    const double x = side * .1, hip_z = pose[of(kLeftHip)].z;
    pose[of(kLeftKnee)] = {x, .6, hip_z + .35};
    pose[of(kLeftAnkle)] = {x, .2, hip_z + .3};
    pose[of(kLeftFoot)] = {x, .1, hip_z + .42};
    pose[of(kLeftElbow)] = {side * .35, .5 + .1 * std::sin(3 * time_s), pose[of(kLeftShoulder)].z};
    pose[of(kLeftWrist)] = pose[of(kLeftElbow)] + glm::dvec3(0, .26, 0);
  }
  return pose;
}

/// Lies face down and lifts the chest.
BodyPose LiftingTheChest(double time_s) {
  BodyPose pose = testing::StandingPerson();
  const double lift = 30 + 15 * std::sin(time_s);
  for (const Role role : AllRoles()) {
    glm::dvec3& joint = pose[role];
    const bool is_leg = joint.y < .89;
    joint = Bowed(joint - glm::dvec3(0, .9, 0), is_leg ? 90 : 90 - lift) + glm::dvec3(0, .1, 1.5);
  }
  return pose;
}

BodyPose StandingStill(double time_s) {
  return Moved(testing::StandingPerson(),
               [&](const glm::dvec3& p) { return p + glm::dvec3(.01 * p.y * std::sin(time_s), 0, 2); });
}

/// Sits at a desk, both hands on it.
BodyPose Sitting(double time_s) {
  BodyPose pose = StandingStill(time_s);
  pose = Moved(pose, [&](const glm::dvec3& p) { return p - glm::dvec3(0, .42, 0); });
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    pose[of(kLeftElbow)] = {side * .2, .75, 2.2};
    pose[of(kLeftWrist)] = {side * .2, .8, 2.45};
    pose[of(kLeftHand)] = {side * .2, .8, 2.55};
    pose[of(kLeftKnee)] = {side * .1, .48, 2.42};
    pose[of(kLeftAnkle)] = {side * .1, .07, 2.42};
    pose[of(kLeftFoot)] = {side * .1, .02, 2.59};
  }
  return pose;
}

/// Goes up stairs towards +Z; one foot stands while the other is lifted.
BodyPose ClimbingStairs(double time_s) {
  BodyPose pose = testing::StandingPerson();
  const double way = .5 * time_s;
  const auto stairs = [&](double z) { return .6 * z; };
  pose = Moved(pose, [&](const glm::dvec3& p) { return p + glm::dvec3(0, stairs(way), way); });
  for (const bool is_left : {true, false}) {
    const double phase = way / .3 + (is_left ? 0 : 1), cycle = std::floor(phase / 2), swing = phase - 2 * cycle - 1;
    const double at = .6 * cycle + .6 * std::max(0.0, swing) - (is_left ? 0 : .3) + .15;
    const auto of = [&](Role role) { return is_left ? role : Mirrored(role); };
    for (const Role role : {of(kLeftAnkle), of(kLeftFoot)}) {
      pose[role].z += at - way;
      pose[role].y += stairs(at) - stairs(way);
    }
    pose[of(kLeftKnee)] = .5 * (pose[of(kLeftAnkle)] + pose[of(kLeftHip)]) + glm::dvec3(0, 0, .1);
  }
  return pose;
}

/// Jumps on a trampoline, 4 m high.
BodyPose Bouncing(double time_s) {
  BodyPose pose = StandingStill(time_s);
  const double flight = std::fmod(time_s, 1.8);
  return Moved(pose, [&](const glm::dvec3& p) { return p + glm::dvec3(0, .5 * 9.81 * flight * (1.8 - flight), 0); });
}

/// Pushes against a wall, standing half a metre from it.
BodyPose LeaningOnAWall(double time_s) {
  BodyPose pose = testing::StandingPerson();
  pose = Moved(pose, [&](const glm::dvec3& p) { return Bowed(p, 15) + glm::dvec3(0, 0, 2); });
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    pose[of(kLeftWrist)] = {side * .25, 1.3, 2.75};
    pose[of(kLeftHand)] = {side * .25, 1.38, 2.77};
    pose[of(kLeftElbow)] = .5 * (pose[of(kLeftWrist)] + pose[of(kLeftShoulder)]) + glm::dvec3(side * .1, -.1, 0);
  }
  pose[kHead].z += .01 * std::sin(time_s);
  return pose;
}

/// Lies on the back with the shanks on a chair: the shape of a person who sits.
BodyPose LyingWithRaisedShanks(double time_s) {
  return Moved(Sitting(time_s), [](const glm::dvec3& p) { return Bowed(p, -90) + glm::dvec3(0, -1.7, 0); });
}

/// Lies on one side with bent hips and knees.
BodyPose LyingCurledUp(double time_s) {
  return Moved(Sitting(time_s), [](const glm::dvec3& p) { return glm::dvec3(p.y, -p.x, p.z) + glm::dvec3(0, .2, 0); });
}

/// Lies on the back with the soles on the floor and the knees up.
BodyPose LyingWithRaisedKnees(double time_s) {
  BodyPose pose = StandingStill(time_s);
  for (const bool is_left : {true, false}) {
    const auto of = [&](Role role) { return is_left ? role : Mirrored(role); };
    pose[of(kLeftKnee)] += glm::dvec3(0, .1, .3);
    pose[of(kLeftAnkle)] += glm::dvec3(0, .3, 0);
    pose[of(kLeftFoot)] = pose[of(kLeftAnkle)] + glm::dvec3(0, -.17, .05);
  }
  return Moved(pose, [](const glm::dvec3& p) { return Bowed(p, -90) + glm::dvec3(0, .1 - 2, 0); });
}

/// Walks on a treadmill in a file whose origin is a metre above its belt.
BodyPose OnATreadmill(double time_s) {
  BodyPose pose = StandingStill(0);
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    const double phase = side * std::sin(5 * time_s);
    for (const Role role : {of(kLeftAnkle), of(kLeftFoot)})
      pose[role] += glm::dvec3(0, .1 * std::max(0.0, phase), .3 * std::cos(5 * time_s) * side);
    pose[of(kLeftKnee)] = .5 * (pose[of(kLeftAnkle)] + pose[of(kLeftHip)]) + glm::dvec3(0, 0, .1);
  }
  return Moved(pose, [](const glm::dvec3& p) { return p - glm::dvec3(0, 1, 0); });
}

/// Bends the knees, with the origin at the height of the head.
BodyPose Squatting(double time_s) {
  BodyPose pose = StandingStill(0);
  const double down = .2 + .2 * std::sin(2 * time_s);
  for (const Role role : AllRoles()) {
    if (pose[role].y > .6) pose[role].y -= down;
  }
  for (const Role role : {kLeftKnee, kRightKnee}) pose[role] += glm::dvec3(0, -.3 * down, .5 * down);
  return Moved(pose, [](const glm::dvec3& p) { return p - glm::dvec3(0, 1.6, 0); });
}

/// Bends the hips from 0° to 60°.
BodyPose Bowing(double time_s) {
  BodyPose pose = testing::StandingPerson();
  const double bow = 30 - 30 * std::cos(2 * time_s);
  for (glm::dvec3& joint : pose.joints) {
    const glm::dvec3 hips = {0, .9, 0};
    if (joint.y > .7) joint = Bowed(joint - hips, bow) + hips;
    joint += glm::dvec3(0, 0, 2);
  }
  return pose;
}

BodyPose SquattingOnTheFloor(double time_s) {
  return Moved(Squatting(time_s), [](const glm::dvec3& p) { return p + glm::dvec3(0, 1.6, 0); });
}

/// Lies on the back and lifts head and shoulders by up to 45°.
BodyPose DoingSitUps(double time_s) {
  BodyPose pose = testing::StandingPerson();
  const double lift = 22.5 - 22.5 * std::cos(2 * time_s);
  for (glm::dvec3& joint : pose.joints) {
    joint = Bowed(joint - glm::dvec3(0, .9, 0), joint.y > .89 ? lift - 90 : -90) + glm::dvec3(0, .1, 1.5);
  }
  return pose;
}

BodyPose SittingBelow(double time_s) {
  return Moved(Sitting(time_s), [](const glm::dvec3& p) { return p - glm::dvec3(0, 1.2, 0); });
}

BodyPose SwayingBelow(double time_s) {
  return Moved(StandingStill(time_s),
               [&](const glm::dvec3& p) { return p + glm::dvec3(.02 * p.y * std::sin(time_s), -1.2, 0); });
}

BodyPose Walking(double time_s) {
  return Moved(ClimbingStairs(time_s), [&](const glm::dvec3& p) { return p - glm::dvec3(0, .3 * time_s, 0); });
}

struct Act {
  const char* name;
  BodyPose (*pose)(double);
};

/// Returns six seconds of an act, turned about the vertical by some quarters; `is_z_up`: in a file with Z up.
std::vector<BodyPose> Film(const Act& act, int quarters, bool is_z_up) {
  std::vector<BodyPose> poses;
  for (int frame = 0; frame < 300; ++frame) {
    BodyPose& pose = poses.emplace_back(act.pose(frame / kRate_hz));
    for (int i = 0; i < quarters; ++i)
      pose = Moved(pose, [](const glm::dvec3& p) { return glm::dvec3(p.z, p.y, -p.x); });
    if (is_z_up) pose = Moved(pose, [](const glm::dvec3& p) { return glm::dvec3(p.x, -p.z, p.y); });
  }
  return poses;
}

TEST(FloorWork, IsNeverStoodUpInSilence) {
  int doubts = 0;
  for (const Act& act : {Act{"crawling", &Crawling}, Act{"push-ups", &PushingUp}, Act{"swimming", &Swimming},
                         Act{"cartwheel", &Wheeling}, Act{"lying", &LyingAway}, Act{"in bed", &LyingInBed},
                         Act{"bench press", &PressingOnABench}, Act{"cobra", &LiftingTheChest}}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      for (const bool is_z_up : {false, true}) {
        // The file's usual axis is not the one that is up.
        const UpFinding found = FindUp(Film(act, quarters, is_z_up), kRate_hz, is_z_up ? TrcUp() : C3dUp(0, false));
        const std::string up = is_z_up ? "Z" : "Y";
        if (AxisName(found.axis) == up) continue;
        EXPECT_THAT(found.doubt, HasSubstr("--up sets another axis")) << act.name << ", quarters: " << quarters;
        doubts +=
            found.doubt.ends_with("if the body is on the floor, " + up + " is up; --up sets another axis") ? 1 : 0;
      }
    }
  }
  EXPECT_GE(doubts, 15) << "each act, with its head along the usual axis, in both kinds of file";
}

TEST(FloorWork, PeopleWhoSitAreUprightWhateverTheUsualAxis) {
  const UpRule of_file = {.evidence = UpEvidence::kFile, .source = "its rule"};
  for (int quarters = 0; quarters < 4; ++quarters) {
    const std::vector<BodyPose> y_up = Film({"sitting", &Sitting}, quarters, false);
    const std::vector<BodyPose> z_up = Film({"sitting", &Sitting}, quarters, true);
    // If the file or its format states another axis, this is doubted. A camera's frame has Y down.
    std::vector<BodyPose> y_down = y_up;
    for (BodyPose& pose : y_down) pose = Moved(pose, [](const glm::dvec3& p) { return glm::dvec3(p.x, -p.y, -p.z); });
    EXPECT_EQ(FindUp(y_up, kRate_hz, AmassUp()).doubt,
              "Z is the convention of AMASS, but the body sits along Y, or lies with bent hips and knees; --up sets "
              "another axis");
    EXPECT_THAT(FindUp(y_down, kRate_hz, AmassUp()).doubt, HasSubstr("the body sits along −Y"));
    EXPECT_THAT(FindUp(z_up, kRate_hz, of_file).doubt, HasSubstr("the body sits along Z"));
    // If it is only a guess, the axis of the posture is taken, unless the body may lie on one side.
    const bool may_lie_on_side = quarters % 2 == 1;
    for (const bool is_z_up : {false, true}) {
      const UpFinding found = is_z_up ? FindUp(z_up, kRate_hz, ArrayUp()) : FindUp(y_up, kRate_hz, C3dUp(0, false));
      EXPECT_EQ(AxisName(found.axis), is_z_up != may_lie_on_side ? "Z" : "Y") << quarters;
      EXPECT_THAT(found.doubt, HasSubstr(may_lie_on_side ? "or lies with bent hips and knees"
                                                         : "Etude assumes from the posture that"));
    }
    // Controls: the usual axis is right.
    EXPECT_EQ(FindUp(z_up, kRate_hz, AmassUp()).doubt, "");
    EXPECT_EQ(FindUp(y_up, kRate_hz, ArrayUp()).doubt, "");
    EXPECT_EQ(FindUp(y_up, kRate_hz, of_file).doubt, "");
  }
}

TEST(FloorWork, IsNotTakenForSitting) {
  for (const Act& act : {Act{"crawling", &Crawling}, Act{"push-ups", &PushingUp},
                         Act{"knees up", &LyingWithRaisedKnees}, Act{"standing", &StandingStill}}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      EXPECT_EQ(FindUp(Film(act, quarters, true), kRate_hz, AmassUp()).doubt, "") << act.name;
    }
  }
  // Two postures have the shape of a person who sits; the doubt names them, too.
  for (const auto& [act, quarters] :
       {std::pair(Act{"on the back", &LyingWithRaisedShanks}, 0), {Act{"on one side", &LyingCurledUp}, 1}}) {
    EXPECT_THAT(FindUp(Film(act, quarters, true), kRate_hz, AmassUp()).doubt,
                HasSubstr("or lies with bent hips and knees"))
        << act.name;
  }
  const UpFinding curled = FindUp(Film({"on one side", &LyingCurledUp}, 0, false), kRate_hz, ArrayUp());
  EXPECT_EQ(AxisName(curled.axis), "Y") << "not stood up";
}

TEST(FloorWork, IsNotSeenInPeopleWhoStandSitClimbJumpOrLean) {
  for (const Act& act : {Act{"standing", &StandingStill}, Act{"sitting", &Sitting}, Act{"stairs", &ClimbingStairs},
                         Act{"bouncing", &Bouncing}, Act{"leaning", &LeaningOnAWall}, Act{"treadmill", &OnATreadmill},
                         Act{"squats", &Squatting}, Act{"sitting low", &SittingBelow}, Act{"swaying", &SwayingBelow}}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      for (const bool is_z_up : {false, true}) {
        const UpFinding found = FindUp(Film(act, quarters, is_z_up), kRate_hz, is_z_up ? C3dUp(0, false) : TrcUp());
        EXPECT_EQ(AxisName(found.axis), is_z_up ? "Z" : "Y") << act.name;
        EXPECT_EQ(found.doubt, "") << act.name << ", quarters: " << quarters;
      }
    }
  }
}

TEST(FloorWork, PeopleWhoSquatOrBowInOnePlaceAreUprightWhateverTheirFacing) {
  for (const Act& act :
       {Act{"squats", &Squatting}, Act{"squats on the floor", &SquattingOnTheFloor}, Act{"bows", &Bowing}}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      const std::vector<BodyPose> z_up = Film(act, quarters, true);
      for (const UpRule& rule : {JointCsvUp(), OwnJointsUp()}) {
        EXPECT_EQ(FindUp(z_up, kRate_hz, rule).doubt,
                  "the body stands along Z, but Y is " + rule.source + "; --up sets another axis")
            << act.name << quarters;
        EXPECT_EQ(FindUp(Film(act, quarters, false), kRate_hz, rule).doubt, "") << act.name << quarters;
      }
      EXPECT_EQ(AxisName(FindUp(z_up, kRate_hz, TrcUp()).axis), "Z") << act.name << quarters;
    }
  }
  // Controls: sit-ups have the shape of bows, and a raised chest, too, but the body is near the floor.
  for (const Act& act :
       {Act{"sit-ups", &DoingSitUps}, Act{"cobra", &LiftingTheChest}, Act{"knees", &LyingWithRaisedKnees},
        Act{"push-ups", &PushingUp}, Act{"bench press", &PressingOnABench}}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      EXPECT_EQ(FindUp(Film(act, quarters, false), kRate_hz, JointCsvUp()).doubt, "") << act.name << quarters;
      EXPECT_EQ(AxisName(FindUp(Film(act, quarters, false), kRate_hz, TrcUp()).axis), "Y") << act.name << quarters;
    }
  }
}

TEST(FloorWork, WhoIsStretchedOutOnTheFloorDoesNotStandAlongAnotherAxis) {
  const Act lying = {"lying still", &LyingStraight};
  for (int quarters = 0; quarters < 4; ++quarters) {
    EXPECT_EQ(FindUp(Film(lying, quarters, false), kRate_hz, C3dUp('Y', false)).doubt, "") << quarters;
    EXPECT_EQ(FindUp(Film(lying, quarters, true), kRate_hz, AmassUp()).doubt, "") << quarters;
    // The control: the same body far above the floor.
    std::vector<BodyPose> above = Film(lying, quarters, false);
    for (BodyPose& pose : above) pose = Moved(pose, [](const glm::dvec3& p) { return p + glm::dvec3(0, 2, 0); });
    EXPECT_THAT(FindUp(above, kRate_hz, C3dUp('Y', false)).doubt, HasSubstr("the body stands along")) << quarters;
  }
}

TEST(FloorWork, OfAmassFarFromItsFloorIsDoubtedIfTheBodyIsNeverUpright) {
  const auto doubt = [](const Act& act, double degrees, double away) {
    // The frame of a camera that looks down by some degrees: Y down, Z ahead.
    std::vector<BodyPose> poses = Film(act, 0, false);
    for (BodyPose& pose : poses) {
      pose = Moved(pose, [&](const glm::dvec3& p) { return Bowed(p, 180 + degrees) + glm::dvec3(0, 1, away); });
    }
    return FindUp(poses, kRate_hz, AmassUp()).doubt;
  };
  for (const double degrees : {0.0, 12.0, 25.0, 35.0}) {
    EXPECT_NE(doubt({"standing", &StandingStill}, degrees, 6), "") << degrees;
    EXPECT_NE(doubt({"bouncing", &Bouncing}, degrees, 6), "") << degrees;
  }
  EXPECT_THAT(doubt({"standing", &StandingStill}, 25, 6),
              HasSubstr("the body is never upright along it, and its lowest joint is"));
  // Controls: people who lie or work on the floor of AMASS, or in a bed.
  for (const Act& act : {Act{"lying", &LyingAway}, Act{"lying still", &LyingStraight}, Act{"push-ups", &PushingUp},
                         Act{"crawling", &Crawling}, Act{"sit-ups", &DoingSitUps},
                         Act{"bench press", &PressingOnABench}, Act{"standing", &StandingStill}}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      EXPECT_EQ(FindUp(Film(act, quarters, true), kRate_hz, AmassUp()).doubt, "") << act.name << quarters;
      EXPECT_THAT(FindUp(Film({"in bed", &LyingInBed}, quarters, true), kRate_hz, AmassUp()).doubt,
                  Not(HasSubstr("never upright")));
    }
  }
}

TEST(ScreenEntry, LosesAgainstAWalkingBodyOnly) {
  for (int quarters = 0; quarters < 4; ++quarters) {
    // A file with Z up whose screen entry (or Motive's convention) states Y.
    for (const UpRule& rule : {C3dUp('Y', false), MotiveUp()}) {
      const UpFinding walk = FindUp(Film({"walk", &Walking}, quarters, true), kRate_hz, rule);
      EXPECT_EQ(AxisName(walk.axis), "Z") << quarters;
      EXPECT_EQ(walk.doubt, "the body walks upright along Z, so Etude takes this axis as up, although Y is " +
                                rule.source + "; --up sets another axis");
      for (const Act& act : {Act{"in bed", &LyingInBed}, Act{"lying", &LyingAway}, Act{"bench", &PressingOnABench},
                             Act{"cobra", &LiftingTheChest}, Act{"push-ups", &PushingUp}, Act{"swim", &Swimming},
                             Act{"crawling", &Crawling}, Act{"standing", &StandingStill}, Act{"walk", &Walking}}) {
        EXPECT_EQ(AxisName(FindUp(Film(act, quarters, false), kRate_hz, rule).axis), "Y") << act.name << quarters;
      }
    }
    EXPECT_EQ(AxisName(FindUp(Film({"walk", &Walking}, quarters, true), kRate_hz, JointCsvUp()).axis), "Y")
        << "the control: a format's own rule";
  }
}

}  // namespace
}  // namespace etude::floor_work
