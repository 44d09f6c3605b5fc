#include "io/clips/raw_motions.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/formats/amass.h"
#include "engine/formats/kimodo.h"
#include "engine/formats/npz.h"
#include "engine/formats/trc.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_layouts.h"
#include "engine/retargeting/opensim_motion.h"
#include "io/clips/body_in_place.h"
#include "io/clips/references.h"
#include "sim/choreography/canonical_body.h"
#include "tests/io/clips/clip_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class RawMotionsTest : public ClipFolder {
 protected:
  static RawMotion Opened(const std::string& reference) {
    auto raw = OpenRawMotion(reference, {});
    EXPECT_TRUE(raw) << ToString(raw.error());
    return raw ? *raw : RawMotion{};
  }
};

/// Returns a body that stands 0.3 m above its file's floor.
BodyMotion Lifted(double rate_hz, std::size_t frames) {
  BodyMotion motion{rate_hz, std::vector<BodyPose>(frames, StandingPose())};
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint.y += 0.3;
  }
  return motion;
}

TEST_F(RawMotionsTest, MarkersKeepTheirRateTheirFloorAndTheirGaps) {
  MarkerMotion markers{.rate_hz = 50, .names = {}, .frames = {}};
  for (const Role role : AllRoles()) markers.names.emplace_back(RoleName(role));
  for (const BodyPose& pose : Lifted(50, 5).poses) markers.frames.emplace_back(pose.joints.begin(), pose.joints.end());
  markers.frames[2][Index(Role::kLeftHand)].reset();
  const RawMotion raw = Opened(Write("a.trc", WriteTrc(markers, "a")));
  EXPECT_EQ(raw.rate_hz, 50);
  ASSERT_EQ(raw.FrameCount(), 5u);
  const auto at = [&](std::size_t frame, Role role) { return raw.At(frame, raw.roles[Index(role)]); };
  EXPECT_FALSE(IsSeen(at(2, Role::kLeftHand)));
  EXPECT_NEAR(glm::distance(at(2, Role::kLeftFoot), Lifted(50, 1).poses[0][Role::kLeftFoot]), 0, 1e-5);
}

TEST_F(RawMotionsTest, EndSitesAreNoneOfTheFilesOwnJoints) {
  const auto file = ExpandReference("assimp:01_01", {}, 1);
  ASSERT_TRUE(file) << ToString(file.error());
  const RawMotion raw = Opened(file->front());
  std::size_t ends = 0;
  for (std::size_t j = 0; j < raw.joints.size(); ++j) {
    const bool is_end = raw.joints[j].ends_with("_End");
    const bool is_added = std::ranges::count(raw.added, static_cast<int>(j)) == 1;
    EXPECT_EQ(is_added, is_end) << raw.joints[j];
    ends += is_end;
  }
  EXPECT_GE(ends, 5u);
  // The joint that carries the hips is the file's root.
  EXPECT_TRUE(HasOwnRoot(raw));
  EXPECT_EQ(raw.joints[raw.roles[Index(Role::kHipCentre)]], "Hips");
}

TEST_F(RawMotionsTest, ArraysOfAnyJointsAreABodyByTheirNames) {
  // SMPL's joints that have roles, with a gap; without feet, hands and spine.
  BodyMotion motion = Lifted(50, 30);
  NumberArray positions{.shape = {30, 14, 3}, .values = {}};
  std::vector<std::string> names;
  for (const Role role : AllRoles()) {
    using enum Role;
    if (role == kHipCentre || role == kSpine || role == kLeftHand || role == kRightHand || role == kLeftFoot || role == kRightFoot)
      continue;
    names.emplace_back(RoleName(role));
  }
  ASSERT_EQ(names.size(), 14u);
  for (const BodyPose& pose : motion.poses) {
    for (const std::string& name : names) {
      const glm::dvec3& p = pose[*FindRole(name)];
      positions.values.insert(positions.values.end(), {p.x, p.y, p.z});
    }
  }
  for (int axis = 0; axis < 3; ++axis) positions.values[7 * 14 * 3 + axis] = std::nan("");
  const std::string file =
      Write("a.npz", WriteNpz({{"positions", positions}, {"rate_hz", {.shape = {}, .values = {50}}}}, {{"names", names}}));
  const auto body = OpenBodyInPlace(file, {});
  ASSERT_TRUE(body) << ToString(body.error());
  EXPECT_EQ(body->motion.rate_hz, 50);
  ASSERT_EQ(body->motion.poses.size(), 30u);
  EXPECT_NEAR(glm::distance(body->motion.poses[7][Role::kLeftKnee], motion.poses[7][Role::kLeftKnee]), 0, 1e-9);
  // With a declared unit of 0.9 m, the body is smaller.
  OpenOptions told;
  told.body.metres_per_unit = 0.9;
  const auto smaller = OpenBodyInPlace(file, told);
  ASSERT_TRUE(smaller) << ToString(smaller.error());
  EXPECT_NEAR(glm::distance(smaller->motion.poses[7][Role::kHead], 0.9 * body->motion.poses[7][Role::kHead]), 0, 1e-9);
}

constexpr std::pair<const char*, Role> kPairedJoints[] = {
    {"Shoulder", Role::kLeftShoulder}, {"Elbow", Role::kLeftElbow}, {"Wrist", Role::kLeftWrist},
    {"Hip", Role::kLeftHip},           {"Knee", Role::kLeftKnee},   {"Ankle", Role::kLeftAnkle}};

/// A recording in the names of HALPE_26, as markers in metres; the head is the middle of nose and crown.
MarkerMotion Keypoints() {
  const BodyPose pose = StandingPose();
  MarkerMotion markers{.rate_hz = 60, .names = {"Nose", "Head", "Neck", "Hip"}, .frames = {}};
  const glm::dvec3 up(0, 0.1, 0);
  std::vector<std::optional<glm::dvec3>> row = {pose[Role::kHead] - up, pose[Role::kHead] + up,
                                                pose[Role::kShoulderCentre], pose[Role::kHipCentre]};
  for (const auto& [name, role] : kPairedJoints) {
    for (const bool is_left : {true, false}) {
      markers.names.push_back((is_left ? "L" : "R") + std::string(name));
      row.emplace_back(pose[is_left ? role : Mirrored(role)]);
    }
  }
  markers.frames.assign(5, row);
  return markers;
}

std::string NpzOf(const MarkerMotion& markers) {
  NumberArray positions{.shape = {markers.frames.size(), markers.names.size(), 3}, .values = {}};
  for (const auto& frame : markers.frames) {
    for (const auto& place : frame) positions.values.insert(positions.values.end(), {place->x, place->y, place->z});
  }
  return WriteNpz({{"positions", positions}, {"rate_hz", {.shape = {}, .values = {markers.rate_hz}}}},
                  {{"names", markers.names}});
}

/// Writes a table with millimetres, which its headings do not state.
std::string TableOf(const MarkerMotion& markers) {
  std::string text = "timestamp_ms";
  for (const std::string& name : markers.names) text += "," + name + "_x," + name + "_y," + name + "_z";
  for (std::size_t f = 0; f < markers.frames.size(); ++f) {
    text += fmt::format("\n{}", 1000 * static_cast<double>(f) / markers.rate_hz);
    for (const auto& place : markers.frames[f]) {
      text += fmt::format(",{},{},{}", 1000 * place->x, 1000 * place->y, 1000 * place->z);
    }
  }
  return text + "\n";
}

TEST_F(RawMotionsTest, ArraysTablesAndMarkersOfTheSameNamesAreTheSameJoints) {
  const RawMotion trc = Opened(Write("a.trc", WriteTrc(Keypoints(), "a")));
  const RawMotion npz = Opened(Write("a.npz", NpzOf(Keypoints())));
  const RawMotion table = Opened(Write("a.csv", TableOf(Keypoints())));
  EXPECT_THAT(table.notes, ::testing::Contains(HasSubstr("1 unit = 0.1 cm, by the size of the body")));
  const BodyPose pose = StandingPose();
  for (const RawMotion& raw : {trc, npz, table}) {
    EXPECT_EQ(raw.rate_hz, 60);
    EXPECT_THAT(raw.notes.front(), HasSubstr("markers: HALPE_26"));
    for (const Role role : {Role::kHead, Role::kShoulderCentre, Role::kLeftKnee, Role::kRightWrist}) {
      EXPECT_NEAR(glm::distance(raw.At(3, raw.roles[Index(role)]), pose[role]), 0, 1e-5) << RoleName(role);
    }
    EXPECT_EQ(raw.roles[Index(Role::kSpine)], -1);
    // The file's own joints keep their names, for `joints: same`; only the head is computed.
    for (const std::string& name : Keypoints().names) EXPECT_EQ(std::ranges::count(raw.joints, name), 1) << name;
    ASSERT_EQ(raw.added.size(), 1u);
    EXPECT_EQ(raw.added.front(), raw.roles[Index(Role::kHead)]);
  }
}

TEST_F(RawMotionsTest, MarkersOfNoKnownSetHaveNoRolesUnlessAJointMapNamesThem) {
  MarkerMotion odd = Keypoints();
  const auto renamed = [](const std::string& name) {  // a name that no naming scheme has
    const std::vector<std::string> names = Keypoints().names;
    return "Q" + std::to_string(std::ranges::find(names, name) - names.begin());
  };
  for (std::string& name : odd.names) name = renamed(name);
  for (auto& frame : odd.frames) {
    for (auto& place : frame) *place = {place->x, -place->z, place->y};  // Z up
  }
  const std::string trc = Write("a.trc", WriteTrc(odd, "a"));
  OpenOptions told;
  told.body.up = UpAxis::kZ;
  auto raw = OpenRawMotion(trc, told);
  ASSERT_TRUE(raw) << ToString(raw.error());
  EXPECT_EQ(raw->roles, RawMotion::NoRoles());
  EXPECT_EQ(raw->joints, odd.names);
  EXPECT_NEAR(glm::distance(raw->At(2, 2), StandingPose()[Role::kShoulderCentre]), 0, 1e-5) << "metres, Y up";
  ASSERT_EQ(raw->notes.size(), 2u);
  EXPECT_THAT(raw->notes[0], HasSubstr("the markers (Q0, Q1, "));
  EXPECT_EQ(raw->notes[1], "Z is up (told)");
  // For any use but a comparison, markers of unknown names are refused.
  EXPECT_THAT(testing::Refusal(OpenBodyInPlace(trc, told)), HasSubstr("belong to no known marker set"));
  // With a joint map of the needed joints they are read as a body, from a marker file and from an array.
  told.roles.emplace();
  using enum Role;
  for (const auto& [name, role] : kPairedJoints) {
    told.roles->joints[role] = {renamed("L" + std::string(name)), {}};
    told.roles->joints[Mirrored(role)] = {renamed("R" + std::string(name)), {}};
  }
  for (const std::string& file : {trc, Write("a.npz", NpzOf(odd))}) {
    const auto mapped = OpenRawMotion(file, told);
    ASSERT_TRUE(mapped) << ToString(mapped.error());
    EXPECT_NEAR(glm::distance(mapped->At(1, mapped->roles[Index(kLeftKnee)]), StandingPose()[kLeftKnee]), 0, 1e-5);
    EXPECT_THAT(mapped->notes.front(), HasSubstr("markers: the joint map"));
    EXPECT_TRUE(OpenBodyInPlace(file, told));
  }
}

TEST_F(RawMotionsTest, JointsPlacedByRulePlayNoRole) {
  MarkerMotion markers{.rate_hz = 30, .names = {}, .frames = {std::vector<std::optional<glm::dvec3>>()}};
  const BodyPose pose = StandingPose();
  for (const Role role : AllRoles()) {
    if (role == Role::kLeftHand || role == Role::kHipCentre) continue;
    markers.names.emplace_back(RoleName(role));
    markers.frames[0].emplace_back(pose[role]);
  }
  const RawMotion raw = Opened(Write("a.trc", WriteTrc(markers, "a")));
  EXPECT_EQ(raw.roles[Index(Role::kLeftHand)], -1);
  const glm::dvec3 middle = 0.5 * (pose[Role::kLeftHip] + pose[Role::kRightHip]);
  EXPECT_NEAR(glm::distance(raw.At(0, raw.roles[Index(Role::kHipCentre)]), middle), 0, 1e-5);
}

/// A joint of Kimodo's skeleton: its parent, and its offset from the parent in the T-pose, metres.
struct PlacedJoint {
  int parent;
  glm::dvec3 offset;
};
constexpr PlacedJoint kSoma[] = {{-1, {0, 1, 0}},          {0, {0, .05, 0}},         {1, {0, .071, 0}},
                                 {2, {0, .076, -.008}},    {3, {0, .263, -.006}},    {4, {0, .077, .023}},
                                 {5, {0, .061, .02}},      {6, {0, .005, .031}},     {6, {.032, .054, .076}},
                                 {6, {-.032, .054, .076}}, {3, {.016, .232, .051}},  {10, {.149, 0, -.055}},
                                 {11, {.287, 0, 0}},       {12, {.271, 0, 0}},       {13, {.123, -.032, .048}},
                                 {13, {.19, -.003, 0}},    {3, {-.016, .232, .051}}, {16, {-.149, 0, -.055}},
                                 {17, {-.287, 0, 0}},      {18, {-.271, 0, 0}},      {19, {-.123, -.032, .048}},
                                 {19, {-.19, -.003, 0}},   {0, {.1, -.084, .026}},   {22, {0, -.432, -.008}},
                                 {23, {0, -.422, -.035}},  {24, {0, -.051, .132}},   {0, {-.1, -.084, .026}},
                                 {26, {0, -.432, -.008}},  {27, {0, -.422, -.035}},  {28, {0, -.051, .132}}};

TEST_F(RawMotionsTest, KimodosArraysKeepTheirRotationsAndContacts) {
  constexpr std::size_t kFrames = 4, kLeftKnee = 23, kLeftFoot = 25;
  NumberArray places{{kFrames, 30, 3}, {}}, matrices{{kFrames, 30, 3, 3}, {}}, contacts{{kFrames, 4}, {}};
  std::vector<glm::dvec3> expected;
  std::vector<glm::dmat3> turned;
  for (std::size_t f = 0; f < kFrames; ++f) {
    std::vector<glm::dvec3> p;
    std::vector<glm::dmat3> r;
    for (std::size_t j = 0; j < 30; ++j) {
      const double bend = j == kLeftKnee ? 0.1 * static_cast<double>(f) : j == 0 ? 0.3 : 0;
      const glm::dvec3 axis = j == 0 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
      const glm::dmat3 own = glm::mat3_cast(glm::angleAxis(bend, axis));
      const auto& [parent, offset] = kSoma[j];
      p.push_back(parent < 0 ? offset : p[parent] + r[parent] * offset);
      r.push_back(parent < 0 ? own : r[parent] * own);
      for (int k = 0; k < 3; ++k) places.values.push_back(p[j][k]);
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) matrices.values.push_back(r[j][column][row]);
      }
    }
    expected.insert(expected.end(), p.begin(), p.end());
    turned.insert(turned.end(), r.begin(), r.end());
    contacts.values.insert(contacts.values.end(), {1, 0, 0, f % 2 == 0 ? 1.0 : 0.0});
  }
  const std::map<std::string, NumberArray> arrays = {
      {"posed_joints", places}, {"global_rot_mats", matrices}, {"foot_contacts", contacts}};
  const RawMotion raw = Opened(Write("k.npz", WriteNpz(arrays, {})));
  ASSERT_EQ(raw.FrameCount(), kFrames);
  EXPECT_EQ(raw.roles[Index(Role::kLeftKnee)], static_cast<int>(kLeftKnee));
  EXPECT_EQ(raw.roles[Index(Role::kLeftFoot)], static_cast<int>(kLeftFoot));
  const std::size_t joints = raw.joints.size();
  for (std::size_t f = 0; f < kFrames; ++f) {
    for (std::size_t j = 0; j < 30; ++j) {
      EXPECT_NEAR(glm::distance(raw.At(f, j), expected[f * 30 + j]), 0, 1e-6);
      EXPECT_NEAR(std::abs(glm::dot(raw.rotations[f * joints + j], glm::quat_cast(turned[f * 30 + j]))), 1, 1e-9);
    }
  }
  EXPECT_EQ(raw.rest_rotations[kLeftKnee], glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(raw.contacts, (std::vector<bool>{1, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0}));
  // Contacts of a wrong shape are refused.
  std::map<std::string, NumberArray> wrong = arrays;
  wrong["foot_contacts"] = {{2, 4}, std::vector<double>(8, 1)};
  EXPECT_THAT(testing::Refusal(OpenRawMotion(Write("w.npz", WriteNpz(wrong, {})), {})),
              HasSubstr("the shape of foot_contacts is 2 × 4; allowed: 4 × 4"));
}

TEST_F(RawMotionsTest, KimodosWholeSkeletonHasItsFingersAndTheSameRoles) {
  // Parents as published; offsets along a line, so that every joint has its own position.
  constexpr int kParents[] = {-1, 0,  1,  2,  3,  4,  5,  6,  6,  6,  6,  3,  11, 12, 13, 14, 15, 16, 17, 14, 19, 20, 21, 22, 14, 24,
                              25, 26, 27, 14, 29, 30, 31, 32, 14, 34, 35, 36, 37, 3,  39, 40, 41, 42, 43, 44, 45, 42, 47, 48, 49, 50,
                              42, 52, 53, 54, 55, 42, 57, 58, 59, 60, 42, 62, 63, 64, 65, 0,  67, 68, 69, 70, 0,  72, 73, 74, 75};
  constexpr std::size_t kJoints = std::size(kParents);
  static_assert(kJoints == 77);
  NumberArray places{{1, kJoints, 3}, {}}, matrices{{1, kJoints, 3, 3}, {}};
  for (std::size_t j = 0; j < kJoints; ++j) {
    for (const double value : {0.01 * static_cast<double>(j), 1.0, 0.0}) places.values.push_back(value);
    for (int k = 0; k < 9; ++k) matrices.values.push_back(k % 4 == 0 ? 1 : 0);
  }
  const auto arrays = [&] {
    Npz made;
    made.arrays = {{"posed_joints", places}, {"global_rot_mats", matrices}};
    return made;
  };
  std::vector<std::string> remarks;
  const Clip clip = ReadKimodo(arrays(), "k.npz", {}, remarks).value();
  ASSERT_EQ(clip.skeleton.joints.size(), kJoints);
  for (std::size_t j = 0; j < kJoints; ++j) EXPECT_EQ(clip.skeleton.joints[j].parent, kParents[j]) << j;
  const std::pair<std::size_t, const char*> kNames[] = {{7, "HeadEnd"},       {10, "RightEye"},     {18, "LeftHandThumbEnd"},
                                                        {28, "LeftHandMiddleEnd"}, {42, "RightHand"}, {66, "RightHandPinkyEnd"},
                                                        {67, "LeftLeg"},      {71, "LeftToeEnd"},   {76, "RightToeEnd"}};
  for (const auto& [index, name] : kNames) EXPECT_EQ(clip.skeleton.joints[index].name, name);
  places.shape[1] = 76;
  const auto refused = ReadKimodo(arrays(), "k.npz", {}, remarks);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("1 × 76 × 3"));
}

TEST_F(RawMotionsTest, KimodosMotionsOfSmplXHaveTheStatedRateOrTheModels) {
  // A person who stands in SMPL's T-pose, in two frames.
  const Skeleton smpl = SmplSkeleton();
  std::vector<GlobalTransform> globals;
  LocalPose rest = RestPose(smpl);
  rest[0].rotation = glm::dquat(1, 0, 0, 0);
  ComputeGlobals(smpl, rest, globals);
  Npz npz;
  NumberArray places{{2, 22, 3}, {}}, matrices{{2, 22, 3, 3}, {}};
  for (std::size_t i = 0; i < 44; ++i) {
    const glm::dvec3 p = globals[i % 22].position;
    places.values.insert(places.values.end(), {p.x, p.y, p.z});
    for (int k = 0; k < 9; ++k) matrices.values.push_back(k % 4 == 0 ? 1 : 0);
  }
  npz.arrays = {{"posed_joints", places}, {"global_rot_mats", matrices}};
  const auto read = [&](std::optional<double> told_hz, std::vector<std::string>& remarks) {
    return ReadKimodo(npz, "k.npz", told_hz, remarks).value();
  };
  std::vector<std::string> remarks;
  const Clip clip = read({}, remarks);
  EXPECT_EQ(clip.rate_hz, 30);
  EXPECT_EQ(remarks, std::vector<std::string>{"the file states no frame rate, so Etude uses 30 Hz, the rate of "
                                              "Kimodo's model"});
  EXPECT_EQ(clip.skeleton.joints[21].name, "right_wrist");
  ComputeGlobals(clip.skeleton, clip.frames[1], globals);
  for (std::size_t j = 0; j < 22; ++j) {
    EXPECT_NEAR(globals[j].position.y, places.values[3 * j + 1], 1e-12) << j;
  }
  // A default is named only if it is used.
  remarks.clear();
  EXPECT_EQ(read(20, remarks).rate_hz, 20);
  npz.arrays["fps"] = {.shape = {}, .values = {25}};
  EXPECT_EQ(read({}, remarks).rate_hz, 25);
  EXPECT_TRUE(remarks.empty());
}

TEST_F(RawMotionsTest, ArraysOfSam3dBodyHaveTheStatedRateAndFormat) {
  const auto layout = JointsOfLayout("mhr70", 70);
  NumberArray joints{.shape = {30, 70, 3}, .values = {}};
  for (std::size_t i = 0; i < 30 * 70; ++i) {
    const auto role = FindRole(layout[i % 70]);
    const glm::dvec3 p = StandingPose()[role.value_or(Role::kHead)];
    joints.values.insert(joints.values.end(), {p.x, 1 - p.y, 4 - p.z});
  }
  std::map<std::string, NumberArray> arrays = {{"pred_keypoints_3d", joints}, {"fps", {.shape = {}, .values = {60}}}};
  ASSERT_OK(file, ReadClipFile(Write("s.npz", WriteNpz(arrays, {}))));
  EXPECT_EQ(FormatName(file->format), "NPZ");
  EXPECT_TRUE(file->has_rate);
  EXPECT_EQ(file->clips.front().rate_hz, 60);
  EXPECT_EQ(file->bodies.front().changes.front(), "layout mhr70");
  EXPECT_EQ(file->bodies.front().up.doubt, "");
  arrays.erase("fps");
  EXPECT_FALSE(ReadClipFile(Write("t.npz", WriteNpz(arrays, {})))->has_rate);
}

TEST_F(RawMotionsTest, AnglesKeepTheClockOfTheirFile) {
  const BodyMotion motion = Lifted(25, 12);
  std::istringstream text(WriteOpenSimMotion(motion, StandingPose(), "a"));
  std::string all, cut;
  int row = -1;  // 0 is the line of headings
  for (std::string line; std::getline(text, line);) {
    if (row >= 0 || line.starts_with("time")) ++row;
    all += line + "\n";
    if (row <= 0 || row > 5) cut += line + "\n";
  }
  EXPECT_EQ(Opened(Write("all.mot", all)).start_s, 0);
  const RawMotion late = Opened(Write("cut.mot", cut));
  EXPECT_EQ(late.start_s, 0.2);
  EXPECT_EQ(late.FrameCount(), 7u);
}

TEST_F(RawMotionsTest, ABuiltInClipIsItsOwnBody) {
  const RawMotion raw = Opened("builtin:clap");
  for (const Role role : AllRoles()) EXPECT_EQ(raw.joints[raw.roles[Index(role)]], RoleName(role));
  EXPECT_TRUE(raw.rotations.empty());
  EXPECT_TRUE(raw.notes.empty());
}

TEST_F(RawMotionsTest, AFileWithoutABodyIsRefused) {
  EXPECT_THAT(testing::Refusal(OpenRawMotion(Write("a.bvh", kTwoJoints), {})), HasSubstr("a.bvh"));
}

TEST_F(RawMotionsTest, ADigestTellsAChangedFile) {
  const std::string path = Write("a.bvh", kTwoJoints);
  const auto before = DigestOfFile(path, {});
  Write("a.bvh", std::string(kTwoJoints) + "\n");
  ASSERT_TRUE(before);
  EXPECT_NE(*before, *DigestOfFile(path, {}));
  EXPECT_FALSE(DigestOfFile(In("none.bvh"), {}));
  EXPECT_NE(*DigestOfFile("builtin:clap", {}), *DigestOfFile("builtin:sway", {}));
}

}  // namespace
}  // namespace etude
