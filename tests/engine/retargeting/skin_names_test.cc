#include "engine/retargeting/skin_names.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "engine/motion/statistics.h"
#include "engine/retargeting/markers.h"
#include "tests/engine/retargeting/standing_person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;
using ::testing::HasSubstr;
using ::testing::Not;

/// A marker: its name for the side "?", its joint of the left side, and its offset outwards, upwards and forwards.
struct SkinMarker {
  std::string name;
  Role role;
  glm::dvec3 off = glm::dvec3(0);
};

/// Returns ten frames; markers whose names have '?' are on both sides, named by `left` and `right`.
MarkerMotion TakeOfSkin(const std::vector<SkinMarker>& markers, const std::string& left = "L.",
                        const std::string& right = "R.") {
  MarkerMotion take{.rate_hz = 50, .names = {}, .frames = decltype(MarkerMotion::frames)(10)};
  for (const auto& [name, role, off] : markers) {
    const std::size_t at = name.find('?');
    for (const bool is_left : {true, false}) {
      if (!is_left && at == std::string::npos) continue;
      std::string full = name;
      if (at != std::string::npos) full.replace(at, 1, is_left ? left : right);
      take.names.push_back(full);
      const glm::dvec3 place = testing::StandingPerson()[is_left ? role : Mirrored(role)];
      for (auto& frame : take.frames) frame.emplace_back(place + glm::dvec3(is_left ? off.x : -off.x, off.y, off.z));
    }
  }
  return take;
}

/// Helen Hayes: front spines and sacrum so that Harrington's regression gives exactly the hips of Standing.
std::vector<SkinMarker> HelenHayes() {
  // Half the width w of the pelvis follows from 0.33·w + 7.3 mm = 90 mm, its height and depth from the other two rows.
  const double w = (0.09 - 0.0073) / 0.33, depth = 0.15, up = 0.30 * w + 0.0109, ahead = 0.24 * depth + 0.0099;
  return {{"Front.Head", kHead, {0, 0, 0.1}},          {"Rear.Head", kHead, {0, 0, -0.1}},
          {"?Shoulder", kLeftShoulder, {0, 0.045, 0}}, {"R.Offset", kSpine, {-0.08, 0, -0.1}},
          {"?Elbow", kLeftElbow, {0.04, 0, 0}},        {"?Wrist", kLeftWrist},
          {"?ASIS", kHipCentre, {w / 2, up, ahead}},   {"V.Sacral", kHipCentre, {0, up, ahead - depth}},
          {"?Thigh", kLeftKnee, {0.09, 0.2, 0}},       {"?Knee", kLeftKnee, {0.05, 0, 0}},
          {"?Shank", kLeftAnkle, {0.07, 0.2, 0}},      {"?Ankle", kLeftAnkle, {0.036, 0, 0}},
          {"?Heel", kLeftAnkle, {0, -0.04, -0.06}},    {"?Toe", kLeftFoot}};
}

/// Returns the largest distance of the needed joints from Standing, and from which joint.
std::pair<double, Role> Furthest(const MarkerBody& body) {
  std::pair<double, Role> furthest{0, kHead};
  for (const Role role : kNeededJoints) {
    const glm::dvec3 wanted = testing::StandingPerson()[role] - glm::dvec3(0, body.floor, 0);
    furthest = std::max(furthest, std::pair(glm::distance(body.motion.poses.front()[role], wanted), role));
  }
  return furthest;
}

TEST(HelenHayes, GivesTheHipsOfThePelvisWhateverItsNamesLookLike) {
  for (const auto& [left, right] :
       {std::pair("L.", "R."), {"L_", "R_"}, {"L", "R"}, {"left_", "right_"}, {"l ", "r "}}) {
    const auto bodies = FindMarkerBodies(TakeOfSkin(HelenHayes(), left, right), "a.trc");
    ASSERT_TRUE(bodies) << left << ToString(bodies.error());
    const auto [distance, role] = Furthest(bodies->front());
    EXPECT_LT(distance, 0.02) << left << RoleName(role);
    EXPECT_LT(glm::distance(bodies->front().motion.poses.front()[kLeftHip] + glm::dvec3(0, bodies->front().floor, 0),
                            testing::StandingPerson()[kLeftHip]),
              1e-9);
    EXPECT_THAT(bodies->front().Note(),
                HasSubstr("skin markers (Helen Hayes); Etude placed joint centres under the skin"));
    EXPECT_EQ(bodies->front().markers[Index(kLeftHip)].size(), 3u) << "two spines and the sacrum";
    EXPECT_EQ(bodies->front().markers[Index(kLeftKnee)], std::vector{std::string(left) + "Knee"});
    EXPECT_TRUE(bodies->front().markers[Index(kSpine)].empty()) << "by rule";
  }
}

TEST(HelenHayes, JointsWithAnInnerMarkerAreMidwayAndStay) {
  std::vector<SkinMarker> markers = HelenHayes();
  markers.push_back({"?Knee.Medial", kLeftKnee, {-0.05, 0, 0}});
  markers.push_back({"?Ankle.Medial", kLeftAnkle, {-0.036, 0, 0}});
  ASSERT_OK(bodies, FindMarkerBodies(TakeOfSkin(markers), "a.trc"));
  const MarkerBody& body = bodies->front();
  for (const Role role : {kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle}) {
    const glm::dvec3 wanted = testing::StandingPerson()[role] - glm::dvec3(0, body.floor, 0);
    EXPECT_LT(glm::distance(body.motion.poses.front()[role], wanted), 1e-9) << RoleName(role);
  }
  EXPECT_THAT(body.Note(), Not(HasSubstr("knees")));
  EXPECT_THAT(body.Note(), HasSubstr("elbows"));
  // An inner marker on the knees only: the ankles still move under the skin.
  markers.pop_back();
  ASSERT_OK(knees, FindMarkerBodies(TakeOfSkin(markers), "a.trc"));
  EXPECT_LT(Furthest(knees->front()).first, 0.02);
}

TEST(HelenHayes, WithoutAPelvisTakesTheFilesHipCentresOrIsRefused) {
  std::vector<SkinMarker> markers = HelenHayes();
  std::erase_if(markers, [](const SkinMarker& one) { return one.role == kHipCentre; });
  const std::string refusal = testing::Refusal(FindMarkerBodies(TakeOfSkin(markers), "a.trc"));
  EXPECT_THAT(refusal,
              HasSubstr("nearest: skin markers (Helen Hayes) lacks left_hip, right_hip; markers on thighs, shanks and "
                        "upper arms do not determine joints"));
  EXPECT_THAT(refusal, HasSubstr("use a joint map (--joint-map) to state which markers are the joints"));
  markers.push_back({"V_?Hip_JC", kLeftHip});
  ASSERT_OK(bodies, FindMarkerBodies(TakeOfSkin(markers), "a.trc"));
  EXPECT_LT(Furthest(bodies->front()).first, 0.02);
  // Markers that the user takes as joints are not moved.
  markers.push_back({"?KneeCentre", kLeftKnee});
  ASSERT_OK(told, FindMarkerBodies(TakeOfSkin(markers), "a.trc", {.roles = {{kLeftKnee, "L.KneeCentre"}}}));
  EXPECT_LT(glm::distance(told->front().motion.poses.front()[kLeftKnee],
                          testing::StandingPerson()[kLeftKnee] - glm::dvec3(0, told->front().floor, 0)),
            1e-9);
}

TEST(SkinMarkers, NamedLikeKeypointsAreNotKeypoints) {
  std::vector<SkinMarker> markers = HelenHayes();
  for (SkinMarker& one : markers) std::erase(one.name, '.');
  markers.push_back({"?PSIS", kHipCentre, {0.05, 0.09, -0.1}});
  markers.push_back({"?Hip", kLeftHip, {0.07, 0, 0}});
  ASSERT_OK(skin, FindMarkerBodies(TakeOfSkin(markers, "L", "R"), "a.trc"));
  EXPECT_THAT(skin->front().Note(), HasSubstr("skin markers"));
  EXPECT_LT(glm::distance(skin->front().motion.poses.front()[kLeftHip],
                          testing::StandingPerson()[kLeftHip] - glm::dvec3(0, skin->front().floor, 0)),
            0.02);
  // The control: with all names of BODY_25, the keypoints count.
  for (const char* name : {"MidHip", "Neck"}) markers.push_back({name, name[0] == 'N' ? kShoulderCentre : kHipCentre});
  markers.push_back({"?Ear", kHead, {0.07, 0, 0}});
  markers.push_back({"?BigToe", kLeftFoot});
  EXPECT_THAT(FindMarkerBodies(TakeOfSkin(markers, "L", "R"), "a.trc")->front().Note(), HasSubstr("OpenPose BODY_25"));
}

TEST(SkinMarkers, OfOpenSimAndOfOtherLabsAreRead) {
  const std::vector<SkinMarker> pelvis = {{"?ASI", kHipCentre, {0.125, 0.0861, 0.0459}},
                                          {"?PSI", kHipCentre, {0.05, 0.0861, -0.1041}}};
  using Rows = std::vector<SkinMarker>;
  for (const Rows& rows : {Rows{{"?ACR", kLeftShoulder, {0, 0.045, 0}},
                                {"?LEL", kLeftElbow, {0.04, 0, 0}},
                                {"?MEL", kLeftElbow, {-0.04, 0, 0}},
                                {"?FAradius", kLeftWrist, {0, 0, 0.03}},
                                {"?FAulna", kLeftWrist, {0, 0, -0.03}},
                                {"?LFC", kLeftKnee, {0.05, 0, 0}},
                                {"?MFC", kLeftKnee, {-0.05, 0, 0}},
                                {"?LMAL", kLeftAnkle, {0.036, 0, 0}},
                                {"?MMAL", kLeftAnkle, {-0.036, 0, 0}},
                                {"?TOE", kLeftFoot}},
                           Rows{{"?ACR", kLeftShoulder, {0, 0.045, 0}},
                                {"?HLE", kLeftElbow, {0.04, 0, 0}},
                                {"?HME", kLeftElbow, {-0.04, 0, 0}},
                                {"?RSP", kLeftWrist, {0, 0, 0.03}},
                                {"?USP", kLeftWrist, {0, 0, -0.03}},
                                {"?FLE", kLeftKnee, {0.05, 0, 0}},
                                {"?FME", kLeftKnee, {-0.05, 0, 0}},
                                {"?FAL", kLeftAnkle, {0.036, 0, 0}},
                                {"?TAM", kLeftAnkle, {-0.036, 0, 0}}},
                           Rows{{"?_shoulder", kLeftShoulder, {0, 0.045, 0}},
                                {"?_lelbow", kLeftElbow, {0.04, 0, 0}},
                                {"?_melbow", kLeftElbow, {-0.04, 0, 0}},
                                {"?_lwrist", kLeftWrist, {0, 0, 0.03}},
                                {"?_mwrist", kLeftWrist, {0, 0, -0.03}},
                                {"?_knee", kLeftKnee, {0.05, 0, 0}},
                                {"?_mknee", kLeftKnee, {-0.05, 0, 0}},
                                {"?_ankle", kLeftAnkle, {0.036, 0, 0}},
                                {"?_mankle", kLeftAnkle, {-0.036, 0, 0}}}}) {
    Rows markers = pelvis;
    markers.insert(markers.end(), rows.begin(), rows.end());
    const auto bodies = FindMarkerBodies(TakeOfSkin(markers, "L", "R"), "a.trc");
    ASSERT_TRUE(bodies) << ToString(bodies.error());
    for (const Role role : {kLeftElbow, kRightElbow, kLeftWrist, kRightKnee, kLeftKnee, kRightAnkle, kLeftAnkle}) {
      const glm::dvec3 wanted = testing::StandingPerson()[role] - glm::dvec3(0, bodies->front().floor, 0);
      EXPECT_LT(glm::distance(bodies->front().motion.poses.front()[role], wanted), 1e-9)
          << rows[1].name << RoleName(role);
    }
  }
}

TEST(SkinMarkers, HaveTheirOwnSizeInMessagesAboutTheUnit) {
  // Millimetres are stated, metres are stored: the regression's millimetres must not count as the body's size.
  MarkerMotion take = TakeOfSkin(HelenHayes());
  const double stature = Stature(FindMarkerBodies(take, "a.c3d")->front().motion.poses.front());
  take.metres_per_unit = 0.001;
  for (auto& frame : take.frames) {
    for (auto& place : frame) *place *= 0.001;
  }
  EXPECT_THAT(FindMarkerBodies(take, "a.c3d")->front().Note(),
              HasSubstr(fmt::format("with the file's unit, the body would be {:.3g} m tall, so Etude multiplies all "
                                    "lengths by 1000",
                                    stature / 1000)));
  EXPECT_THAT(testing::Refusal(FindMarkerBodies(take, "a.c3d", {.metres_per_unit = 0.001})),
              HasSubstr(fmt::format("the body is {:.3g} m tall", stature / 1000)));
}

TEST(AThighMarker, BetweenPelvisAndKneeIsNeverAHip) {
  std::vector<SkinMarker> markers = HelenHayes();
  std::erase_if(markers, [](const SkinMarker& one) { return one.role == kHipCentre || one.name == "?Shank"; });
  EXPECT_THAT(
      testing::Refusal(FindMarkerBodies(TakeOfSkin(markers), "a.trc")),
      HasSubstr(
          "L.Thigh is on the thigh instead of the hip, because its distance from L.Knee is 0.49 times the distance "
          "from that marker to L.Ankle; allowed: "));
  // The control: "thigh" at the hip, as bones are called.
  for (SkinMarker& one : markers) {
    if (one.name == "?Thigh") one = {"?Thigh", kLeftHip};
  }
  ASSERT_OK(bones, FindMarkerBodies(TakeOfSkin(markers), "a.trc"));
  EXPECT_THAT(bones->front().Note(), HasSubstr("joint names of a skeleton"));
}

/// The names of a laboratory or a device: of the pelvis, front and back; of the limbs; and what stands for '?'.
struct Lab {
  const char *front, *back, *left, *right, *set;
  std::vector<SkinMarker> limbs;
};

TEST(SkinMarkers, OfLabsWithTheirOwnNamesOfThePelvisAreRead) {
  constexpr const char* kMade = "skin markers (Helen Hayes)";
  /// Outer and inner markers of elbow, wrist, knee and ankle.
  const auto paired = [](const char* shoulder, const std::vector<std::array<const char*, 2>>& names) {
    constexpr std::pair<Role, glm::dvec3> kJoints[] = {
        {kLeftElbow, {0.04, 0, 0}}, {kLeftWrist, {0, 0, 0.03}}, {kLeftKnee, {0.05, 0, 0}}, {kLeftAnkle, {0.036, 0, 0}}};
    std::vector<SkinMarker> markers = {{shoulder, kLeftShoulder, {0, 0.045, 0}}};
    for (std::size_t i = 0; i < names.size(); ++i) {
      markers.push_back({names[i][0], kJoints[i].first, kJoints[i].second});
      markers.push_back({names[i][1], kJoints[i].first, -kJoints[i].second});
    }
    return markers;
  };
  const auto gait = [](std::vector<SkinMarker> markers) {
    markers.push_back({"?SHO", kLeftShoulder, {0, 0.045, 0}});
    markers.push_back({"?ELB", kLeftElbow, {0.04, 0, 0}});
    markers.push_back({"?KNE", kLeftKnee, {0.05, 0, 0}});
    markers.push_back({"?ANK", kLeftAnkle, {0.036, 0, 0}});
    markers.push_back({"?TOE", kLeftFoot});
    return markers;
  };
  for (Lab lab : {
           Lab{"?IAS", "?IPS", "L_", "R_", kMade,  // Istituto Ortopedico Rizzoli, names of the ISB
               paired("?SAE", {{"?HLE", "?HME"}, {"?RSP", "?USP"}, {"?FLE", "?FME"}, {"?FAL", "?TAM"}})},
           Lab{"?ASI", "?PSI", "pLeft", "pRight", kMade,  // Xsens
               paired("?Acromion", {{"?ArmLatEpicondyle", "?ArmMedEpicondyle"},
                                    {"?RadialStyloid", "?UlnarStyloid"},
                                    {"?KneeLatEpicondyle", "?KneeMedEpicondyle"},
                                    {"?LatMalleolus", "?MedMalleolus"}})},
           Lab{"Waist?Front", "Waist?Back", "L", "R", kMade,  // OptiTrack
               paired("?ShoulderTop", {{"?ElbowOut", "?ElbowIn"},
                                       {"?WristOut", "?WristIn"},
                                       {"?KneeOut", "?KneeIn"},
                                       {"?AnkleOut", "?AnkleIn"}})},
           Lab{"?FWT", "?BWT", "L", "R", "Plug-in Gait with CMU's waist",
               gait({{"?WRA", kLeftWrist, {0, 0, 0.03}}, {"?WRB", kLeftWrist, {0, 0, -0.03}}})},
           Lab{"?ASI", "?PSI", "L", "R", "Plug-in Gait", gait({{"?WRI", kLeftWrist}})},
       }) {
    lab.limbs.push_back({lab.front, kHipCentre, {0.125, 0.0861, 0.0459}});
    lab.limbs.push_back({lab.back, kHipCentre, {0.05, 0.0861, -0.1041}});
    ASSERT_OK(bodies, FindMarkerBodies(TakeOfSkin(lab.limbs, lab.left, lab.right), "a.c3d"));
    EXPECT_THAT(bodies->front().Note(), ::testing::StartsWith(lab.set));
    const auto [distance, role] = Furthest(bodies->front());
    EXPECT_LT(distance, 0.02) << lab.front << ": " << RoleName(role);
  }
  // Joint centres that a laboratory has computed are joints.
  ASSERT_OK(centres, FindMarkerBodies(TakeOfSkin({{"?HJC", kLeftHip},
                                                  {"?KJC", kLeftKnee},
                                                  {"?AJC", kLeftAnkle},
                                                  {"?SJC", kLeftShoulder},
                                                  {"?EJC", kLeftElbow},
                                                  {"?WJC", kLeftWrist}},
                                                 "L", "R"),
                                      "a.c3d"));
  EXPECT_THAT(centres->front().Note(), ::testing::StartsWith("joint names of a skeleton"));
  EXPECT_LT(Furthest(centres->front()).first, 1e-9);
}

}  // namespace
}  // namespace etude
