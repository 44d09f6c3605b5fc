#include "engine/retargeting/markers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kTakeFrames = 40;

/// Somebody who stands, facing +Z, and sways; metres, Y up.
BodyPose StandingAt(std::size_t frame) {
  const double sway = 0.01 * static_cast<double>(frame);
  BodyPose pose;
  const auto put = [&](Role role, double x, double y, double z) { pose[role] = {x + sway, y, z}; };
  put(Role::kHipCentre, 0, 0.9, 0);
  put(Role::kSpine, 0, 1.15, 0);
  put(Role::kShoulderCentre, 0, 1.4, 0);
  put(Role::kHead, 0, 1.6, 0);
  for (const double side : {1.0, -1.0}) {
    const auto of = [&](Role role) { return side > 0 ? role : Mirrored(role); };
    put(of(Role::kLeftShoulder), side * 0.18, 1.4, 0);
    put(of(Role::kLeftElbow), side * 0.2, 1.1, 0);
    put(of(Role::kLeftWrist), side * 0.2, 0.85, 0);
    put(of(Role::kLeftHand), side * 0.2, 0.7, 0);
    put(of(Role::kLeftHip), side * 0.09, 0.9, 0);
    put(of(Role::kLeftKnee), side * 0.09, 0.48, 0);
    put(of(Role::kLeftAnkle), side * 0.09, 0.07, 0);
    put(of(Role::kLeftFoot), side * 0.09, 0.02, 0.17);
  }
  return pose;
}

/// The markers of a take; `markers_of` gives their places in a pose.
MarkerMotion Take(const std::vector<std::string>& names,
                  const std::function<std::vector<glm::dvec3>(const BodyPose&)>& markers_of) {
  MarkerMotion take{.rate_hz = 50, .names = names, .frames = {}};
  for (std::size_t t = 0; t < kTakeFrames; ++t) {
    const auto places = markers_of(StandingAt(t));
    take.frames.emplace_back(places.begin(), places.end());
  }
  return take;
}

MarkerMotion OwnJoints() {
  std::vector<std::string> names;
  for (const Role role : AllRoles()) names.emplace_back(RoleName(role));
  return Take(names,
              [](const BodyPose& pose) { return std::vector<glm::dvec3>(pose.joints.begin(), pose.joints.end()); });
}

double FurthestJoint(const BodyMotion& motion, std::size_t first = 0) {
  double furthest = 0;
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    BodyPose wanted = StandingAt(first + t);
    for (glm::dvec3& joint : wanted.joints) joint.y -= 0.02;  // the floor is under the toes
    for (const Role role : AllRoles())
      furthest = std::max(furthest, glm::distance(motion.poses[t][role], wanted[role]));
  }
  return furthest;
}

TEST(Markers, OfOurOwnNamesAreTheJoints) {
  const auto bodies = FindMarkerBodies(OwnJoints(), "a.trc");
  ASSERT_TRUE(bodies) << ToString(bodies.error());
  ASSERT_EQ(bodies->size(), 1u);
  EXPECT_EQ(bodies->front().motion.rate_hz, 50);
  EXPECT_EQ(bodies->front().motion.poses.size(), kTakeFrames);
  EXPECT_LT(FurthestJoint(bodies->front().motion), 1e-12);
  EXPECT_EQ(bodies->front().note, "Etude's joints");
}

TEST(Markers, AreTurnedUprightWhicheverAxisPointsUp) {
  for (const auto& turn :
       std::vector<std::function<glm::dvec3(glm::dvec3)>>{[](glm::dvec3 p) { return glm::dvec3(p.x, -p.z, p.y); },
                                                          [](glm::dvec3 p) { return glm::dvec3(p.y, -p.x, p.z); },
                                                          [](glm::dvec3 p) { return glm::dvec3(p.x, -p.y, -p.z); }}) {
    MarkerMotion take = OwnJoints();
    for (auto& frame : take.frames) {
      for (auto& place : frame) place = turn(*place);
    }
    const auto bodies = FindMarkerBodies(take, "a.trc");
    ASSERT_TRUE(bodies);
    EXPECT_LT(FurthestJoint(bodies->front().motion), 1e-12);
  }
}

TEST(Markers, AtZeroAreGapsUnlessTheyAreAlwaysThere) {
  MarkerMotion take = OwnJoints();
  for (std::size_t t = 10; t < 14; ++t) take.frames[t][Index(Role::kLeftHip)] = glm::dvec3(0);
  const auto bridged = FindMarkerBodies(take, "a.trc");
  ASSERT_TRUE(bridged) << ToString(bridged.error());
  EXPECT_LT(FurthestJoint(bridged->front().motion), 1e-12);
  EXPECT_EQ(bridged->front().note, "Etude's joints, 4 places bridged over gaps; 4 places at 0, 0, 0 taken for gaps");
  MarkerMotion rooted = OwnJoints();
  for (auto& frame : rooted.frames) {
    const glm::dvec3 root = *frame[Index(Role::kHipCentre)];
    for (auto& place : frame) *place -= root;
  }
  EXPECT_EQ(FindMarkerBodies(rooted, "a.trc")->front().note, "Etude's joints");
}

TEST(Markers, InAWrongUnitAreTakenForAPersonOrRefused) {
  for (const double factor : {1000.0, 10.0, 0.1, 0.001}) {
    MarkerMotion take = OwnJoints();
    for (auto& frame : take.frames) {
      for (auto& place : frame) *place *= factor;
    }
    const auto bodies = FindMarkerBodies(take, "a.trc");
    ASSERT_TRUE(bodies) << ToString(bodies.error());
    EXPECT_LT(FurthestJoint(bodies->front().motion), 1e-12);
    EXPECT_THAT(bodies->front().note, HasSubstr(fmt::format("m tall: taken for {:g} times that", 1 / factor)));
  }
  MarkerMotion take = OwnJoints();
  for (auto& frame : take.frames) {
    for (auto& place : frame) *place *= 4;
  }
  const auto giant = FindMarkerBodies(take, "a.trc");
  ASSERT_FALSE(giant);
  EXPECT_THAT(ToString(giant.error()), HasSubstr("a.trc: its markers show a body 6.65 m tall"));
}

TEST(Markers, OfPlugInGaitGiveJointsInsideTheLimbs) {
  // Front markers at (±a, h, f), back markers at (±b, h, −f): the regression of Harrington et al. by hand.
  const double a = 0.12, f = 0.07;
  const auto take = Take(
      {"Me:LFHD", "Me:RFHD", "Me:LBHD", "Me:RBHD", "Me:C7",   "Me:CLAV", "Me:T10",  "Me:STRN", "Me:LSHO", "Me:RSHO",
       "Me:LELB", "Me:RELB", "Me:LWRA", "Me:RWRA", "Me:LWRB", "Me:RWRB", "Me:LFIN", "Me:RFIN", "Me:LASI", "Me:RASI",
       "Me:LPSI", "Me:RPSI", "Me:LKNE", "Me:RKNE", "Me:LANK", "Me:RANK", "Me:LTOE", "Me:RTOE", "Me:LTHI"},
      [&](const BodyPose& pose) {
        const auto around = [&](Role role, double x, double y, double z) { return pose[role] + glm::dvec3(x, y, z); };
        const glm::dvec3 pelvis = pose[Role::kHipCentre] + glm::dvec3(0, 0.0829, -0.0265);
        return std::vector<glm::dvec3>{around(Role::kHead, 0.07, 0, 0.09),
                                       around(Role::kHead, -0.07, 0, 0.09),
                                       around(Role::kHead, 0.07, 0, -0.09),
                                       around(Role::kHead, -0.07, 0, -0.09),
                                       around(Role::kShoulderCentre, 0, 0, -0.06),
                                       around(Role::kShoulderCentre, 0, 0, 0.06),
                                       around(Role::kSpine, 0, 0, -0.1),
                                       around(Role::kSpine, 0, 0, 0.1),
                                       around(Role::kLeftShoulder, 0, 0.045, 0),
                                       around(Role::kRightShoulder, 0, 0.045, 0),
                                       pose[Role::kLeftElbow],
                                       pose[Role::kRightElbow],
                                       around(Role::kLeftWrist, 0, 0, 0.03),
                                       around(Role::kRightWrist, 0, 0, 0.03),
                                       around(Role::kLeftWrist, 0, 0, -0.03),
                                       around(Role::kRightWrist, 0, 0, -0.03),
                                       pose[Role::kLeftHand],
                                       pose[Role::kRightHand],
                                       pelvis + glm::dvec3(a, 0, f),
                                       pelvis + glm::dvec3(-a, 0, f),
                                       pelvis + glm::dvec3(0.05, 0, -f),
                                       pelvis + glm::dvec3(-0.05, 0, -f),
                                       around(Role::kLeftKnee, 0.05, 0, 0),
                                       around(Role::kRightKnee, -0.05, 0, 0),
                                       around(Role::kLeftAnkle, 0.035, 0, 0),
                                       around(Role::kRightAnkle, -0.035, 0, 0),
                                       pose[Role::kLeftFoot],
                                       pose[Role::kRightFoot],
                                       pose[Role::kLeftHip]};
      });
  const auto bodies = FindMarkerBodies(take, "a.c3d");
  ASSERT_TRUE(bodies) << ToString(bodies.error());
  const MarkerBody& body = bodies->front();
  EXPECT_EQ(body.name, "Me");
  EXPECT_EQ(body.note, "Plug-in Gait, placed by rule: hip_centre");
  const BodyPose& pose = body.motion.poses.front();
  const double depth = 2 * f, width = 2 * a;
  const glm::dvec3 hip = pose[Role::kLeftHip];
  EXPECT_NEAR(hip.x, 0.33 * width + 0.0073, 1e-9);
  EXPECT_NEAR(hip.y + 0.02, 0.9 + 0.0829 - 0.30 * width - 0.0109, 1e-9);
  EXPECT_NEAR(hip.z, -0.0265 + f - 0.24 * depth - 0.0099, 1e-9);
  BodyPose wanted = StandingAt(0);
  for (const Role role : AllRoles()) {
    EXPECT_LT(glm::distance(pose[role], wanted[role] - glm::dvec3(0, 0.02, 0)), 0.015) << RoleName(role);
  }
}

TEST(Markers, OfPoseEstimatorsAreTakenAndWhatTheyLackIsPlacedByRule) {
  const std::vector<std::string> names = {"Nose",   "Neck",   "RShoulder", "RElbow",  "RWrist", "LShoulder", "LElbow",
                                          "LWrist", "MidHip", "RHip",      "RKnee",   "RAnkle", "LHip",      "LKnee",
                                          "LAnkle", "REar",   "LEar",      "LBigToe", "RBigToe"};
  const auto take = Take(names, [](const BodyPose& pose) {
    const auto at = [&](Role role) { return pose[role]; };
    return std::vector<glm::dvec3>{at(Role::kHead) + glm::dvec3(0, 0, 0.1),
                                   at(Role::kShoulderCentre),
                                   at(Role::kRightShoulder),
                                   at(Role::kRightElbow),
                                   at(Role::kRightWrist),
                                   at(Role::kLeftShoulder),
                                   at(Role::kLeftElbow),
                                   at(Role::kLeftWrist),
                                   at(Role::kHipCentre),
                                   at(Role::kRightHip),
                                   at(Role::kRightKnee),
                                   at(Role::kRightAnkle),
                                   at(Role::kLeftHip),
                                   at(Role::kLeftKnee),
                                   at(Role::kLeftAnkle),
                                   at(Role::kHead) - glm::dvec3(0.07, 0, 0),
                                   at(Role::kHead) + glm::dvec3(0.07, 0, 0),
                                   at(Role::kLeftFoot),
                                   at(Role::kRightFoot)};
  });
  const auto bodies = FindMarkerBodies(take, "a.trc");
  ASSERT_TRUE(bodies) << ToString(bodies.error());
  EXPECT_EQ(bodies->front().note, "OpenPose BODY_25, placed by rule: spine, left_hand, right_hand");
  EXPECT_LT(FurthestJoint(bodies->front().motion), 0.03);
}

TEST(Markers, GapsAreBridgedAndLongOnesCutOff) {
  MarkerMotion take = OwnJoints();
  take.rate_hz = 10;  // ten frames are a second
  const std::size_t wrist = Index(Role::kLeftWrist), knee = Index(Role::kRightKnee);
  for (std::size_t t = 5; t < 9; ++t) take.frames[t][wrist].reset();
  for (std::size_t t = 25; t < 38; ++t) take.frames[t][knee].reset();
  const auto bodies = FindMarkerBodies(take, "a.trc");
  ASSERT_TRUE(bodies);
  EXPECT_EQ(bodies->front().motion.poses.size(), 25u);
  EXPECT_LT(FurthestJoint(bodies->front().motion), 1e-12) << "the sway is straight";
  EXPECT_EQ(
      bodies->front().note,
      "Etude's joints, 4 places bridged over gaps, frames 1 to 25 of 40 (elsewhere joints are lost for over 1 s)");
}

TEST(Markers, OfTwoPeopleAreTwoBodies) {
  MarkerMotion take = OwnJoints();
  for (std::string& name : take.names) name = "Ann:" + name;
  const MarkerMotion other = OwnJoints();
  for (const std::string& name : other.names) take.names.push_back("Bob:" + name);
  for (std::size_t t = 0; t < kTakeFrames; ++t) {
    take.frames[t].insert(take.frames[t].end(), other.frames[t].begin(), other.frames[t].end());
  }
  const auto bodies = FindMarkerBodies(take, "a.c3d");
  ASSERT_TRUE(bodies);
  ASSERT_EQ(bodies->size(), 2u);
  EXPECT_EQ((*bodies)[0].name, "Ann");
  EXPECT_EQ((*bodies)[1].name, "Bob");
}

TEST(Markers, OfNoKnownSetAreRefusedWithWhatIsLacking) {
  MarkerMotion take = OwnJoints();
  take.names[Index(Role::kLeftKnee)] = "knee";
  const auto refused = FindMarkerBodies(take, "a.c3d");
  ASSERT_FALSE(refused);
  EXPECT_THAT(ToString(refused.error()), HasSubstr("a.c3d: its markers (hip_centre, "));
  EXPECT_THAT(ToString(refused.error()),
              HasSubstr("are of no set known here: Etude's joints lacks left_knee; known: "));
}

TEST(Markers, ThatLieOnEachOtherGiveNoNumberThatIsNone) {
  auto take = OwnJoints();
  for (auto& frame : take.frames) {
    for (auto& place : frame) place = glm::dvec3(0);
  }
  const auto bodies = FindMarkerBodies(take, "a.trc");
  if (!bodies) return;
  for (const BodyPose& pose : bodies->front().motion.poses) {
    for (const glm::dvec3& joint : pose.joints) EXPECT_TRUE(std::isfinite(joint.x + joint.y + joint.z));
  }
}

}  // namespace
}  // namespace etude
