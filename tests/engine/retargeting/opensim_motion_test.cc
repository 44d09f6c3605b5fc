#include "engine/retargeting/opensim_motion.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <sstream>

#include "engine/base/angles.h"
#include "engine/base/names.h"
#include "engine/retargeting/array_evidence.h"
#include "engine/retargeting/joint_arrays.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/engine/retargeting/turned_bodies.h"
#include "tests/support/gaps.h"
#include "tests/support/kept_lines.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;
using ::testing::HasSubstr;

/// Returns the values of each row of a .mot by column name.
std::vector<std::map<std::string, double>> RowsOf(const std::string& mot) {
  std::istringstream text(mot.substr(mot.find("\nendheader\n") + 11));
  std::string line, word;
  std::getline(text, line);
  std::vector<std::string> names;
  for (std::istringstream words(line); words >> word;) names.push_back(word);
  std::vector<std::map<std::string, double>> rows;
  while (std::getline(text, line)) {
    std::istringstream words(line);
    auto& row = rows.emplace_back();
    for (const std::string& name : names) words >> row[name];
  }
  return rows;
}

TEST(OpenSimMotion, ReadsBackWhereTheJointsWere) {
  ASSERT_OK(move, LoadBuiltinMove("boxing"));
  const std::string text = WriteOpenSimMotion(move->motion, StandingPose(), "boxing\tround 1");
  EXPECT_THAT(text, HasSubstr("Motion boxing_round 1,"));
  EXPECT_TRUE(HasModelOfAngles(text));
  ASSERT_OK(read, ReadOpenSimMotion(text, "a.mot"));
  EXPECT_EQ(read->rate_hz, move->motion.rate_hz);
  EXPECT_LT(WorstJointDistance(*read, move->motion), 1e-5);
}

TEST(OpenSimMotion, FlexionIsPositiveOnBothSidesAndEachAngleItsOwn) {
  const BodyPose rest = AtAttention();
  const glm::dvec3 x(1, 0, 0), z(0, 0, 1);
  struct Bend {
    Role at;
    glm::dvec3 axis;
    const char* angle;
  };
  // Legs forward, shanks back, toes up, legs inwards, forearms forward.
  for (const Bend& bend : {Bend{kRightHip, -x, "hip_flexion_r"},
                           {kLeftHip, -x, "hip_flexion_l"},
                           {kRightKnee, x, "knee_angle_r"},
                           {kLeftKnee, x, "knee_angle_l"},
                           {kRightAnkle, -x, "ankle_angle_r"},
                           {kLeftHip, -z, "hip_adduction_l"},
                           {kRightHip, z, "hip_adduction_r"},
                           {kLeftElbow, -x, "elbow_flex_l"},
                           {kRightElbow, -x, "elbow_flex_r"}}) {
    const BodyPose pose = Turned(rest, bend.at, glm::angleAxis(Radians(25), bend.axis));
    const auto rows = RowsOf(WriteOpenSimMotion({.rate_hz = 30, .poses = {pose}}, rest, ""));
    ASSERT_EQ(rows.size(), 1u);
    for (const auto& [name, value] : rows[0]) {
      if (name.starts_with("pelvis_t") || name == "time") continue;
      EXPECT_NEAR(value, name == bend.angle ? 25 : 0, 1e-4) << name << " of " << bend.angle;
    }
  }
}

TEST(OpenSimMotion, AMirroredMotionHasTheAnglesOfTheOtherSide) {
  const auto move = LoadBuiltinMove("boxing");
  BodyMotion mirrored = move->motion;
  for (BodyPose& pose : mirrored.poses) pose = MirrorImage(pose);
  const auto rows = RowsOf(WriteOpenSimMotion(move->motion, StandingPose(), ""));
  auto others = RowsOf(WriteOpenSimMotion(mirrored, MirrorImage(StandingPose()), ""));
  for (std::size_t f = 0; f < rows.size(); f += 7) {
    for (const auto& [name, value] : rows[f]) {
      if (!name.ends_with("_r") && !name.ends_with("_l")) continue;
      const std::string twin = name.substr(0, name.size() - 1) + (name.ends_with("r") ? "l" : "r");
      EXPECT_NEAR(others[f][twin], value, 1e-4) << name << ", frame " << f;
    }
  }
}

TEST(OpenSimMotion, AnglesGoOnWithoutJumpsOfWholeTurns) {
  const BodyPose rest = StandingPose();
  BodyMotion motion{.rate_hz = 30, .poses = {}};
  for (int k = 0; k < 40; ++k) {
    motion.poses.push_back(Turned(rest, kHipCentre, glm::angleAxis(Radians(20.0 * k), glm::dvec3(0, 1, 0))));
  }
  const auto rows = RowsOf(WriteOpenSimMotion(motion, rest, ""));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_NEAR(rows[k].at("pelvis_rotation"), 20.0 * static_cast<double>(k), 1e-4);
  }
}

TEST(OpenSimMotion, RowsThatAreMissingAreGapsOfTheirLength) {
  ASSERT_OK(move, LoadBuiltinMove("boxing"));
  std::istringstream text(WriteOpenSimMotion(move->motion, StandingPose(), "boxing"));
  std::string all;
  int row = -1;  // row 0 holds the headings
  for (std::string line; std::getline(text, line);) {
    if (row >= 0 || line.starts_with("time")) ++row;
    if (row <= 20 || row > 35) all += line + "\n";
  }
  std::string note;
  ASSERT_OK(read, ReadOpenSimMotion(all, "a.mot", &note));
  ASSERT_EQ(read->poses.size(), move->motion.poses.size());
  EXPECT_THAT(note, HasSubstr("by their times, 15 of"));
  EXPECT_LT(glm::distance(read->poses[40][kLeftWrist], move->motion.poses[40][kLeftWrist]), 1e-5);
  // Within a gap, joints move linearly.
  const glm::dvec3 a = move->motion.poses[19][kLeftWrist], b = move->motion.poses[35][kLeftWrist];
  EXPECT_LT(glm::distance(read->poses[27][kLeftWrist], 0.5 * (a + b)), 1e-5);
}

TEST(OpenSimMotion, ReadsRadiansAndClocksWithGaps) {
  const BodyPose rest = StandingPose();
  const std::string good = WriteOpenSimMotion({.rate_hz = 25, .poses = {rest, rest, rest}}, rest, "");
  const auto rate = [&](const std::string& from, const std::string& to) {
    return ReadOpenSimMotion(testing::Replaced(good, from, to), "a.mot").value().rate_hz;
  };
  EXPECT_EQ(rate("inDegrees=yes", "inDegrees=no"), 25);
  EXPECT_EQ(rate("\n0.040000", "\n0.060000"), 50) << "two rows are missing";
  // The heading names the knee twice.
  EXPECT_THAT(testing::Refusal(ReadOpenSimMotion(
                  testing::Replaced(good, "\tknee_angle_l\t", "\tknee_angle_l\tknee_angle_l\t"), "a.mot")),
              HasSubstr("the column 'knee_angle_l' is in the file twice; allowed: once"));
}

TEST(OpenSimMotion, TheUnitOfAnglesIsReadOrSaid) {
  ASSERT_OK(move, LoadBuiltinMove("boxing"));
  const std::string degrees = WriteOpenSimMotion(move->motion, StandingPose(), "boxing");
  // Write the angles of the rows again, in radians.
  const std::size_t table = degrees.find("\nendheader\n") + 11, rows = degrees.find('\n', table) + 1;
  std::string radians = degrees.substr(0, rows);
  std::istringstream lines(degrees.substr(rows));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    int column = 0;
    for (double value = 0; words >> value; ++column) {
      const bool is_angle = column > 0 && (column < 4 || column > 6);  // after the time; the translation is 4 to 6
      radians += fmt::format("{}{:.9f}", column == 0 ? "" : "\t", is_angle ? Radians(value) : value);
    }
    radians += '\n';
  }
  const auto noted = [&](const std::string& text, const std::string& unit) {
    std::string note;
    const auto read = ReadOpenSimMotion(testing::Replaced(text, "inDegrees=yes\n", unit), "a.mot", &note);
    EXPECT_TRUE(read) << ToString(read.error());
    EXPECT_LT(read ? WorstJointDistance(*read, move->motion) : 1.0, 1e-4) << unit;
    return note;
  };
  for (const char* unit : {"inDegrees=no\n", "inDegrees=No\n", "inDegrees = no\r\n", "INDEGREES=NO\n"}) {
    EXPECT_EQ(noted(radians, unit), "") << unit;
  }
  for (const char* unit : {"inDegrees=yes\n", "inDegrees=YES\n", "indegrees = Yes\n"}) {
    EXPECT_EQ(noted(degrees, unit), "") << unit;
  }
  EXPECT_THAT(noted(degrees, ""),
              HasSubstr("the file has no line inDegrees, so Etude reads the angles as degrees (the largest is"));
  EXPECT_THAT(noted(radians, ""),
              HasSubstr("the file has no line inDegrees, so Etude reads the angles as radians (the largest is"));
  // A unit that the angles contradict is refused, or said.
  const auto read = [](const std::string& text, std::string* note = nullptr) {
    return ReadOpenSimMotion(text, "a.mot", note);
  };
  EXPECT_THAT(testing::Refusal(read(testing::Replaced(degrees, "inDegrees=yes", "inDegrees = No"))),
              HasSubstr("inDegrees=no, but"));
  EXPECT_EQ(testing::Refusal(read(testing::Replaced(degrees, "inDegrees=yes", "inDegrees=maybe"))),
            "a.mot:5:1: found 'indegrees=maybe'; allowed: inDegrees=yes or inDegrees=no");
  std::string note;
  ASSERT_OK(wrong, read(radians, &note));
  EXPECT_THAT(note, HasSubstr("inDegrees=yes, but the largest angle is"));
  // A body that hardly leaves its rest pose is no contradiction.
  const BodyPose rest = StandingPose();
  note.clear();
  ASSERT_OK(still, read(WriteOpenSimMotion({.rate_hz = 25, .poses = {rest, rest, rest}}, rest, ""), &note));
  EXPECT_EQ(note, "");
}

TEST(BodyNpz, ReadsBackWhereTheJointsWere) {
  const auto move = LoadBuiltinMove("boxing");
  ASSERT_OK(arrays, ReadNpz(WriteBodyNpz(move->motion, StandingPose()), "a.npz"));
  EXPECT_TRUE(IsBodyNpz(*arrays));
  ASSERT_OK(read, BodyOf(ReadRawNpz(*arrays, "a.npz").value()));
  EXPECT_EQ(read->rate_hz, move->motion.rate_hz);
  EXPECT_LT(WorstJointDistance(*read, move->motion), 1e-12);
  // The rotations and translations give the same positions, parent by parent.
  const auto& turns = arrays->arrays.at("rotations").values;
  const auto& shifts = arrays->arrays.at("translations").values;
  for (std::size_t f = 0; f < read->poses.size(); f += 9) {
    std::array<glm::dvec3, kRoleCount> places;
    std::array<glm::dquat, kRoleCount> global;
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const double *q = &turns[4 * (f * kRoleCount + i)], *t = &shifts[3 * (f * kRoleCount + i)];
      const auto parent = static_cast<int>(arrays->arrays.at("parents").values[i]);
      const glm::dquat turn(q[0], q[1], q[2], q[3]);
      const glm::dvec3 shift(t[0], t[1], t[2]);
      global[i] = parent < 0 ? turn : global[static_cast<std::size_t>(parent)] * turn;
      places[i] = parent < 0
                      ? shift
                      : places[static_cast<std::size_t>(parent)] + global[static_cast<std::size_t>(parent)] * shift;
      EXPECT_LT(glm::distance(places[i], read->poses[f].joints[i]), 1e-9) << f << ", joint " << i;
    }
  }
}

TEST(JointsOfArray, TakesTheLayoutOfAsManyJointsAndTheUnitOfAPerson) {
  for (const auto& [unit, metres] : {std::pair("100", 1.0), {"1", 0.01}, {"0.1", 0.001}}) {
    NumberArray array{{2, 20, 3}, {}};
    for (int i = 0; i < 120; ++i) array.values.push_back(i % 3 == 1 ? 0.09 * (i / 3 % 20) / metres : 0.1 / metres);
    array.values[3] = NAN;
    ASSERT_OK(read, JointsOfArray(array, std::nullopt, "a.npy", UpAxis::kY));
    EXPECT_EQ(read->motion.remark, std::string("layout etude, 1 unit = ") + unit + " cm");
    EXPECT_EQ(read->motion.names[2], "shoulder_centre");
    EXPECT_FALSE(read->motion.frames[0][1]);
    EXPECT_LT(glm::distance(*read->motion.frames[1][10], glm::dvec3(0.1, 0.9, 0.1)), 1e-12);
  }
}

TEST(JointsOfArray, RefusesOtherShapes) {
  for (const std::vector<std::size_t>& shape : {std::vector<std::size_t>{20, 3}, {0, 20, 3}, {1, 20, 4}, {1, 5, 3}}) {
    std::size_t count = 1;
    for (const std::size_t size : shape) count *= size;
    EXPECT_FALSE(JointsOfArray({shape, std::vector<double>(count)}, {}, "a.npy")) << shape.size();
  }
  EXPECT_TRUE(JointsOfArray({{1, 17, 3}, std::vector<double>(51)}, "h36m", "a.npy")) << "one of several layouts";
}

TEST(OpenSimMotion, ComplaintsAreAsTheyWere) {
  BodyMotion motion = LoadBuiltinMove("jump").value().motion;
  motion.poses.resize(12);
  motion.rate_hz = 59.94;
  const std::string text = WriteOpenSimMotion(motion, StandingPose(), "a\tjump\x7f");
  const std::string changes =
      "inDegrees=yes>inDegrees=no^part hip_centre>part hip^part left_knee>part left_hip^after ground>behind ground^"
      "after hip_centre>after head^bone>limb^bone 0 0 0>bone 0 0^turns>turn^+Z>*Z^+Z>+W^-X>-XX^\ntime>\ntimes^"
      "\tpelvis_tx>\tpelvis_t^\nendheader>\nendheader\n^\nendheader>\nend^\n0.000000>\n0.000000\t1^"
      "\n0.000000>\n0.0x^\n0.016683>\n0.018^\n0.016683>\n0.0167^\npart head>\npar head^after ground>after spine^"
      "\n0.050050>\n0.900000^\tpelvis_ty>\tpelvis_y";
  const auto read = [](const std::string& mot) { return ReadOpenSimMotion(mot, "a.mot"); };
  testing::ComplaintLines complaints;
  for (const std::string& change : testing::Parts(changes)) {
    const std::vector<std::string> both = testing::Parts(change, '>');
    complaints.Add(Quote(change), std::vector{testing::Replaced(text, both[0], both[1])}, read);
  }
  for (const double rate : {0.05, 0.1, 30.0, 29.97, 10000.0, 20000.0}) {
    motion.rate_hz = rate;
    complaints.Add(fmt::format("{} Hz", rate), std::vector{WriteOpenSimMotion(motion, StandingPose(), "a")}, read);
  }
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/retargeting/opensim_complaints.txt"));
}

TEST(JointArrays, AreUnderstoodAsTheyWere) {
  std::vector<std::string> lines = {JointLayoutNames()};
  testing::Dice dice(9);
  for (const std::size_t joints : {16u, 17u, 20u, 22u, 24u, 25u, 26u}) {
    for (const std::optional<std::string>& layout :
         {std::optional<std::string>(), std::optional<std::string>("coco"), std::optional<std::string>("smpl")}) {
      for (const double spread : {0.5, 0.81, 90.0, 1700.0, 1e10}) {
        NumberArray array{.shape = {3, joints, 3}, .values = {}};
        for (std::size_t i = 0; i < 9 * joints; ++i) array.values.push_back(0.5 * spread * dice.Signed());
        array.values[4] = std::numeric_limits<double>::quiet_NaN();
        const auto joints = JointsOfArray(array, layout, "a.npy");
        if (!joints) lines.push_back(ToString(joints.error()));
        if (!joints) continue;
        const MarkerMotion& motion = joints->motion;
        lines.push_back(fmt::format("{}; the last is {} at {} Hz", motion.remark, motion.names.back(), motion.rate_hz));
      }
    }
  }
  EXPECT_TRUE(testing::AreKept(lines, "tests/engine/retargeting/joint_arrays.txt"));
}

TEST(JointArrays, OfSam3dBodyAreTurnedFromTheCamerasFrame) {
  Npz arrays;
  NumberArray joints{.shape = {2, 70, 3}, .values = std::vector<double>(420, 0.0)};
  joints.values[3 * 70 + 3] = 1;  // frame 1, joint 1, x
  arrays.arrays["pred_keypoints_3d"] = joints;
  std::string note;
  const auto read = [&] { return JointsOfSam(arrays, "a.npz", note); };
  ASSERT_OK(still, read());
  EXPECT_EQ((*still)->values[3 * 70 + 3], 1);
  EXPECT_THAT(note, HasSubstr("the body stays in place"));
  // The axis of the only person of each picture may be left out, in each of the two arrays.
  for (const bool has_people : {false, true}) {
    arrays.arrays["pred_cam_t"] = {.shape = {2, 3}, .values = {0, 0, 3, 0.25, 0.5, 4}};
    if (has_people) arrays.arrays["pred_cam_t"].shape = {2, 1, 3};
    if (has_people) arrays.arrays["pred_keypoints_3d"].shape = {2, 1, 70, 3};
    ASSERT_OK(moved, read());
    EXPECT_EQ((*moved)->shape, (std::vector<std::size_t>{2, 70, 3}));
    EXPECT_EQ((*moved)->values[2], -3);
    EXPECT_EQ(std::vector<double>(&(*moved)->values[213], &(*moved)->values[216]),
              (std::vector<double>{1.25, -0.5, -4}));
    EXPECT_EQ(note,
              "SAM 3D Body's arrays are in the camera's frame; Etude rotated them to Y up, assuming a level camera");
  }
  // Other shapes are refused.
  arrays.arrays["pred_cam_t"].shape = {3, 2};
  EXPECT_EQ(testing::Refusal(read()),
            "a.npz: the array pred_cam_t has the shape 3 × 2, and pred_keypoints_3d the shape 2 × 1 × 70 × 3; allowed: "
            "frames × 3 and frames × joints × 3, with the same number of frames");
  arrays.arrays["pred_keypoints_3d"].shape = {1, 2, 70, 3};
  EXPECT_EQ(testing::Refusal(read()),
            "a.npz: the array pred_keypoints_3d has the shape 1 × 2 × 70 × 3; allowed: frames × joints × 3, for one "
            "person");
  ASSERT_OK(none, JointsOfSam({}, "a.npz", note));
  EXPECT_FALSE(*none);
  // The same joints as a bare array: the body stands on its head unless Y is declared up.
  NumberArray bare{.shape = {4, 70, 3}, .values = std::vector<double>(840, 0.0)};
  for (std::size_t i = 0; i < 280; ++i) {
    const auto joint = JointsOfLayout("mhr70", 70)[i % 70];
    bare.values[3 * i + 1] = joint.ends_with("shoulder") ? -1.4 : joint.ends_with("knee") ? -0.5 : 0;
    bare.values[3 * i + 2] = 3;
  }
  ASSERT_OK(turned, JointsOfArray(bare, std::nullopt, "a.npy"));
  EXPECT_EQ((*turned->motion.frames[2][5]), glm::dvec3(0, 1.4, -3));
  EXPECT_THAT(turned->motion.remark, HasSubstr("as in a camera's frame"));
  EXPECT_TRUE(turned->is_of_camera);
  ASSERT_OK(kept, JointsOfArray(bare, std::nullopt, "a.npy", UpAxis::kY));
  EXPECT_EQ((*kept->motion.frames[2][5]), glm::dvec3(0, -1.4, 3));
  EXPECT_FALSE(kept->is_of_camera);
  // The joints' indices as the layouts' authors list them.
  const auto keypoints = JointsOfLayout("mhr70", 70), whole = JointsOfLayout("mhr", 127);
  EXPECT_EQ(keypoints[15] + keypoints[50] + keypoints[41] + keypoints[69], "left_footleft_handright_wristshoulder_centre");
  EXPECT_EQ(whole[2] + whole[20] + whole[42] + whole[126], "left_hipright_ankleright_wristhead");
}

TEST(BodyNpz, TakesJointsByTheirNamesInAnyOrder) {
  const BodyMotion motion = LoadBuiltinMove("clap").value().motion;
  Npz arrays = ReadNpz(WriteBodyNpz(motion, AtAttention()), "a.npz").value();
  std::vector<std::string>& names = arrays.texts.at("names");
  std::vector<double>& values = arrays.arrays.at("positions").values;
  // Exchange the first and the last joint, with their names.
  std::swap(names.front(), names.back());
  for (std::size_t at = 0; at < values.size(); at += 3 * kRoleCount) {
    for (std::size_t axis = 0; axis < 3; ++axis) std::swap(values[at + axis], values[at + 3 * (kRoleCount - 1) + axis]);
  }
  ASSERT_OK(read, BodyOf(ReadRawNpz(arrays, "a.npz").value()));
  EXPECT_LT(WorstJointDistance(*read, motion), 1e-12);
  names.front() = "tail";
  EXPECT_FALSE(BodyOf(ReadRawNpz(arrays, "a.npz").value())) << "a joint that is none of the twenty";
  names.front() = std::string(RoleName(AllRoles().back()));
  values[7] = std::nan("");
  EXPECT_FALSE(BodyOf(ReadRawNpz(arrays, "a.npz").value())) << "a gap";
}

TEST(BodyNpz, IsInTheUnitAndOnTheAxisThatTheFileOrTheUserTells) {
  const BodyMotion motion = LoadBuiltinMove("clap").value().motion;
  const Npz metres = ReadNpz(WriteBodyNpz(motion, AtAttention()), "a.npz").value();
  /// Returns the positions in another unit, with Z up if asked.
  const auto written = [&](double unit, bool is_z_up, const std::string& unit_text, const std::string& up) {
    Npz arrays = metres;
    std::vector<double>& values = arrays.arrays.at("positions").values;
    for (std::size_t at = 0; at < values.size(); at += 3) {
      const double y = values[at + 1], z = values[at + 2];
      if (is_z_up) values[at + 1] = -z, values[at + 2] = y;
      for (int axis = 0; axis < 3; ++axis) values[at + axis] /= unit;
    }
    arrays.texts["unit"] = {unit_text};
    arrays.texts["up"] = {up};
    for (const auto& [name, value] : {std::pair("unit", unit_text), {"up", up}}) {
      if (!value.empty()) continue;
      arrays.texts.erase(name);
      std::erase(arrays.skipped, name);
    }
    return arrays;
  };
  const auto off = [&](const Npz& arrays, const ArrayOptions& told = {}) {
    const auto raw = ReadRawNpz(arrays, "a.npz", told);
    return raw ? WorstJointDistance(*BodyOf(*raw), motion) : 1e9;
  };
  // Values of another type are refused.
  for (const char* const name : {"unit", "up"}) {
    Npz other = metres;
    other.texts.erase(name);
    other.arrays[name] = {{3}, {0, 0, 1}};
    EXPECT_THAT(testing::Refusal(ReadRawNpz(other, "a.npz", {})), HasSubstr(name)) << name;
    other.arrays.erase(name);
    other.skipped.emplace_back(name);
    EXPECT_THAT(testing::Refusal(ReadRawNpz(other, "a.npz", {})), HasSubstr(name)) << name;
  }
  EXPECT_LT(off(metres), 1e-12);
  EXPECT_THAT(ReadRawNpz(metres, "a.npz")->notes, ::testing::IsEmpty());
  // The unit is a key of the file.
  for (const auto& [text, unit] : {std::pair("cm", 0.01), {"mm", 0.001}, {"in", 0.0254}, {"0.5", 0.5}}) {
    EXPECT_LT(off(written(unit, false, text, "")), 1e-9) << text;
    EXPECT_LT(off(written(unit, true, text, "Z")), 1e-9) << text;
    EXPECT_LT(off(written(unit, true, "", ""), {.metres_per_unit = unit, .up = UpAxis::kZ}), 1e-9) << text;
  }
  // Without a unit or with "m", a body 170 or 1700 units tall is read as centimetres or millimetres, with a note; one
  // of 17 units is refused.
  for (const double unit : {0.01, 0.001}) {
    for (const char* said : {"", "m"}) {
      const Npz arrays = written(unit, false, said, "");
      EXPECT_LT(off(arrays), 1e-9) << unit;
      EXPECT_THAT(ReadRawNpz(arrays, "a.npz")->notes,
                  ::testing::ElementsAre(HasSubstr(fmt::format("1 unit = {:g} cm", 100 * unit))));
    }
  }
  EXPECT_THAT(testing::Refusal(ReadRawNpz(written(0.1, false, "", ""), "a.npz")), HasSubstr("allowed: at most 4"));
  EXPECT_THAT(testing::Refusal(ReadRawNpz(written(1, false, "ell", ""), "a.npz")), HasSubstr("'ell' is not a unit"));
  EXPECT_THAT(testing::Refusal(ReadRawNpz(written(1, false, "", "x"), "a.npz")), HasSubstr("allowed: y, z"));
  // The rate is missing.
  Npz timeless = metres;
  timeless.arrays.erase("rate_hz");
  EXPECT_THAT(testing::Refusal(ReadRawNpz(timeless, "a.npz")), HasSubstr("found no rate_hz (frames per second)"));
  EXPECT_EQ(ReadRawNpz(timeless, "a.npz", {.rate_hz = 50})->rate_hz, 50);
  // A camera's axes: Y down, Z forward.
  Npz seen = metres;
  for (std::size_t i = 0; i < seen.arrays.at("positions").values.size(); ++i) {
    if (i % 3 != 0) seen.arrays.at("positions").values[i] *= -1;
  }
  seen.texts.erase("up");
  std::erase(seen.skipped, "up");
  EXPECT_LT(off(seen), 1e-12);
  EXPECT_THAT(ReadRawNpz(seen, "a.npz")->notes, ::testing::ElementsAre(HasSubstr("as in a camera's frame")));
  EXPECT_THAT(ReadRawNpz(seen, "a.npz", {.up = UpAxis::kY})->notes, ::testing::IsEmpty());
  // A declared up axis is doubted if by this axis the body lies on the floor or stands on its head.
  for (const auto& [up, said] : {std::pair("z", "lies along the floor"), {"y", "lies along the floor"}}) {
    EXPECT_THAT(ReadRawNpz(written(1, *up == 'y', "", up), "a.npz")->notes,
                ::testing::Contains(HasSubstr(fmt::format("with the file's `up: {}`, the body {}", up, said))));
  }
  seen.texts["up"] = {"y"};
  EXPECT_THAT(ReadRawNpz(seen, "a.npz")->notes, ::testing::ElementsAre(HasSubstr("stands on its head")));
  // Z up, undeclared: the body may lie.
  EXPECT_THAT(ReadRawNpz(written(1, true, "", ""), "a.npz")->notes, ::testing::ElementsAre(HasSubstr("lies along Z")));
}

TEST(BodyNpz, IsMeasuredWithoutABallAndLeftInNoUnitThatMakesItTiny) {
  const BodyMotion motion = LoadBuiltinMove("clap").value().motion;
  Npz arrays = ReadNpz(WriteBodyNpz(motion, AtAttention()), "a.npz").value();
  arrays.texts["unit"] = {"0.1"};
  ASSERT_OK(tiny, ReadRawNpz(arrays, "a.npz"));
  EXPECT_LT(WorstJointDistance(*BodyOf(*tiny), motion), 1e-12);
  EXPECT_THAT(
      tiny->notes,
      ::testing::ElementsAre(HasSubstr("1 unit = 100 cm, because in units of 0.1 m the joints would extend 0.1")));
  // A ball five metres away does not belong to the body.
  arrays.texts.erase("unit");
  std::erase(arrays.skipped, "unit");
  NumberArray& positions = arrays.arrays.at("positions");
  NumberArray with_ball{.shape = {positions.shape[0], kRoleCount + 1, 3}, .values = {}};
  for (std::size_t f = 0; f < positions.shape[0]; ++f) {
    const auto frame = positions.values.begin() + static_cast<std::ptrdiff_t>(3 * kRoleCount * f);
    with_ball.values.insert(with_ball.values.end(), frame, frame + 3 * kRoleCount);
    for (const double place : {5.0, 0.1, 5.0}) with_ball.values.push_back(place);
  }
  positions = with_ball;
  arrays.texts["names"].push_back("ball");
  ASSERT_OK(raw, ReadRawNpz(arrays, "a.npz"));
  EXPECT_THAT(raw->notes, ::testing::IsEmpty());
  EXPECT_EQ(raw->At(0, kRoleCount), glm::dvec3(5, 0.1, 5));
  // Two hands with 42 points in one place do not make head and feet outliers.
  std::vector<glm::dvec3> hands;
  for (int i = 0; i < 42; ++i) hands.emplace_back(0.001 * i, 1, 0.3);
  for (int i = 0; i < 28; ++i) hands.emplace_back(0, 1.7 * i / 27, 0);
  EXPECT_NEAR(SpreadOf(hands, hands.size()), 1.7, 1e-12);
}

TEST(BodyNpz, OnItsHandsStaysAHandstandAndAFootAlwaysAtZeroIsNotSeen) {
  // Upside down, with straight arms on the floor.
  BodyMotion motion = LoadBuiltinMove("clap").value().motion;
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint = {-joint.x, 2.3 - joint.y, joint.z};
    for (const Role elbow : {kLeftElbow, kRightElbow}) {
      const bool is_left = elbow == kLeftElbow;
      const glm::dvec3 shoulder = pose[is_left ? kLeftShoulder : kRightShoulder];
      pose[elbow] = shoulder - glm::dvec3(0, 0.3, 0);
      pose[is_left ? kLeftWrist : kRightWrist] = shoulder - glm::dvec3(0, 0.55, 0);
      pose[is_left ? kLeftHand : kRightHand] = shoulder - glm::dvec3(0, 0.7, 0);
    }
  }
  Npz arrays = ReadNpz(WriteBodyNpz(motion, AtAttention()), "a.npz").value();
  arrays.texts.erase("up");
  std::erase(arrays.skipped, "up");
  ASSERT_OK(read, ReadRawNpz(arrays, "a.npz"));
  EXPECT_LT(WorstJointDistance(*BodyOf(*read), motion), 1e-12);
  EXPECT_THAT(read->notes, ::testing::ElementsAre(HasSubstr("on its hands")));
  ASSERT_OK(joints, JointsOfArray(arrays.arrays.at("positions"), std::nullopt, "a.npy"));
  EXPECT_LT(glm::distance(*joints->motion.frames[3][0], motion.poses[3].joints[0]), 1e-12);
  EXPECT_THAT(joints->motion.remark, HasSubstr("on its hands"));
  // One foot is at (0, 0, 0), which marks a gap.
  std::vector<double>& values = arrays.arrays.at("positions").values;
  for (std::size_t at = 3 * Index(kLeftFoot); at < values.size(); at += 3 * kRoleCount) {
    for (std::size_t axis = 0; axis < 3; ++axis) values[at + axis] = 0;
  }
  ASSERT_OK(gaps, ReadRawNpz(arrays, "a.npz", {.up = UpAxis::kY}));
  EXPECT_FALSE(IsSeen(gaps->At(5, Index(kLeftFoot))));
  EXPECT_TRUE(IsSeen(gaps->At(5, Index(kRightFoot))));
  EXPECT_THAT(gaps->notes, ::testing::ElementsAre(HasSubstr("positions at (0, 0, 0) as missing")));
}

TEST(BodyNpz, IsRefusedBeyondItsLimits) {
  const BodyMotion motion = LoadBuiltinMove("clap").value().motion;
  const Npz arrays = ReadNpz(WriteBodyNpz(motion, AtAttention()), "a.npz").value();
  EXPECT_FALSE(IsBodyNpz({}));
  const auto complaint = [&](const std::vector<double>& rate, double place, std::size_t joints) {
    Npz changed = arrays;
    changed.arrays["rate_hz"].values = rate;
    changed.arrays["positions"].values[7] = place;
    changed.arrays["positions"].shape[1] = joints;
    return testing::Refusal(ReadRawNpz(changed, "a.npz"));
  };
  for (const double rate : {0.1, 10000.0}) EXPECT_EQ(complaint({rate}, 0, 20), "accepted") << rate;
  for (const double rate : {0.0, 0.09, 10001.0}) EXPECT_NE(complaint({rate}, 0, 20), "accepted") << rate;
  EXPECT_NE(complaint({30, 30}, 0, 20), "accepted");
  EXPECT_NE(complaint({30}, 2e9, 20), "accepted");
  EXPECT_NE(complaint({30}, 0, 19), "accepted");
  Npz twice = arrays;
  twice.texts["names"][3] = twice.texts["names"][2];
  EXPECT_THAT(testing::Refusal(ReadRawNpz(twice, "a.npz")), HasSubstr("twice"));
  // A file without names has the twenty roles, but names that cannot be read are refused.
  Npz pickled = arrays;
  pickled.texts.erase("names");
  std::erase(pickled.skipped, "names");
  EXPECT_TRUE(ReadRawNpz(pickled, "a.npz"));
  pickled.skipped.emplace_back("names");
  EXPECT_THAT(testing::Refusal(ReadRawNpz(pickled, "a.npz")),
              HasSubstr("the array 'names' is not a list of texts; allowed: a list"));
}

}  // namespace
}  // namespace etude
