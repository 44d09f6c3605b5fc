#include <fmt/format.h>

#include "engine/formats/acclaim.h"
#include "engine/formats/amass.h"
#include "engine/formats/bvh.h"
#include "engine/formats/c3d.h"
#include "engine/formats/deepmimic.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/motion_bids.h"
#include "engine/formats/motive_csv.h"
#include "engine/formats/npz.h"
#include "engine/formats/rigid_targets.h"
#include "engine/formats/trc.h"
#include "engine/motion/character.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/markers.h"
#include "engine/retargeting/opensim_motion.h"
#include "engine/retargeting/to_body.h"
#include "tests/engine/streams/small_files.h"
#include "tests/fuzz/readers/target.h"
#include "tests/support/c3d_writer.h"
#include "tests/support/random_clip.h"

namespace etude::fuzz {
namespace {

/// What every clip goes through next, whatever its file was.
void MakeBody(const Clip& clip) {
  const auto map = FindJointMap(clip.skeleton, kFile);
  if (map) ToBodyMotion(clip, *map, kFile);
}

void Bvh(std::string_view bytes) {
  const auto clip = ReadBvh(bytes, kFile);
  if (!clip) return;
  MakeBody(*clip);
  Required(ReadBvh(WriteBvh(*clip), kFile), "a clip that was written is not read");
}

/// Two joints that turn and an end site, in so many frames.
std::string SmallBvh(int frames) {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 90 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
      "Yrotation\n\tJOINT LeftUpLeg\n\t{\n\t\tOFFSET 10 0 0\n\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n\t\tEnd "
      "Site\n\t\t{\n\t\t\tOFFSET 0 -40 0\n\t\t}\n\t}\n}\nMOTION\n";
  text += fmt::format("Frames: {}\nFrame Time: 0.0333333\n", frames);
  for (int t = 0; t < frames; ++t) text += fmt::format("0 90 {} 0 0 {} 5 -{} 0\n", t, 10 * t, t);
  return text;
}

/// A person of sixteen joints, as deep as people go, all but standing still.
std::string PersonBvh() {
  std::string text =
      "HIERARCHY\nROOT Hips\n{ OFFSET 0 90 0 CHANNELS 6 Xposition Yposition Zposition Zrotation "
      "Xrotation Yrotation\n";
  const auto chain = [&](std::initializer_list<const char*> joints) {
    for (const char* joint : joints) text += fmt::format("JOINT {} CHANNELS 3 Zrotation Xrotation Yrotation\n", joint);
    text += "End Site { OFFSET 0 5 8 }\n";
    for (std::size_t i = 0; i < joints.size(); ++i) text += "}\n";
  };
  chain({"LeftUpLeg { OFFSET 10 0 0", "LeftLeg { OFFSET 0 -40 0", "LeftFoot { OFFSET 0 -40 0"});
  chain({"RightUpLeg { OFFSET -10 0 0", "RightLeg { OFFSET 0 -40 0", "RightFoot { OFFSET 0 -40 0"});
  text += "JOINT Spine { OFFSET 0 20 0 CHANNELS 3 Zrotation Xrotation Yrotation\n";
  chain({"LeftArm { OFFSET 20 25 0", "LeftForeArm { OFFSET 25 0 0", "LeftHand { OFFSET 25 0 0"});
  chain({"RightArm { OFFSET -20 25 0", "RightForeArm { OFFSET -25 0 0", "RightHand { OFFSET -25 0 0"});
  chain({"Neck { OFFSET 0 30 0", "Head { OFFSET 0 10 0"});
  text += "}\n}\nMOTION\nFrames: 2\nFrame Time: 0.0333333\n";
  for (int t = 0; t < 2; ++t) {
    text += "0 90 0";
    for (int i = 0; i < 3 * 16; ++i) text += fmt::format(" {}", t);
    text += '\n';
  }
  return text;
}

std::vector<std::string> BvhSeeds() { return {SmallBvh(1), SmallBvh(4), PersonBvh()}; }

void Gltf(std::string_view bytes) {
  // Whatever a file asks for beside it is there, and wrong.
  const auto content = ReadGltf(bytes, kFile, [](const std::string&) { return std::string(512, '\x3f'); });
  if (!content) return;
  for (const Clip& clip : content->clips) MakeBody(clip);
  const auto again = ReadGltf(WriteGlb(content->character, content->clips), kFile, nullptr);
  Required(again, "a figure that was written is not read");
}

std::vector<std::string> GltfSeeds() {
  const Clip clip = Required(ReadBvh(SmallBvh(3), kFile), "a seed");
  Character figure{.name = "seed", .skeleton = clip.skeleton, .materials = {}, .meshes = {}};
  return {WriteGlb(figure, {}), WriteGlb(figure, {&clip, 1}),
          R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"a","children":[1],)"
          R"("mesh":0},{"name":"b","translation":[0,1,0],"rotation":[0,0,0,1],"scale":[1,1,1]}],)"
          R"("buffers":[{"uri":"a.bin","byteLength":512}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":480,)"
          R"("byteStride":12}],"accessors":[{"bufferView":0,"byteOffset":0,"componentType":5126,"count":3,)"
          R"("type":"VEC3","max":[1,1,1],"min":[0,0,0]},{"bufferView":0,"componentType":5126,"count":3,)"
          R"("type":"SCALAR"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":4}]}],)"
          R"("animations":[{"samplers":[{"input":1,"output":0,"interpolation":"LINEAR"}],)"
          R"("channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}]})"};
}

void Trc(std::string_view bytes) {
  if (const auto markers = ReadTrc(bytes, kFile)) FindMarkerBodies(*markers, kFile);
  RequireRoundTrip(
      bytes, [](std::string_view text) { return ReadTrc(text, kFile); },
      [](const MarkerMotion& motion) { return WriteTrc(motion, kFile); });
}

/// The channels, a form feed, the rows.
void Bids(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\f'), bytes.size());
  const std::string_view rows = bytes.substr(std::min(end + 1, bytes.size()));
  if (const auto markers = ReadMotionBids(rows, bytes.substr(0, end), 30, {kFile, kFile})) FindMarkerBodies(*markers, kFile);
}

std::string BidsSeed() {
  const BidsFiles files = WriteMotionBids(testing::WavingMotion(3), "seed", "1");
  return files[1].second + "\f" + files[0].second;
}

void Csv(std::string_view bytes) { ReadJointCsv(bytes, kFile); }
void Targets17(std::string_view bytes) { ReadRigidTargets(bytes, kFile); }

std::string RigidRows() {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    for (std::size_t target = 0; target < kBodyTargetCount; ++target) text += "1.5 800 -2e3 0 0 0 1 ";
    text += '\n';
  }
  return text;
}

void DeepMimic(std::string_view bytes) {
  const auto clip = ReadDeepMimicMotion(bytes, kFile);
  if (clip) MakeBody(*clip);
}

std::string DeepMimicText() {
  std::string frame = "0.0333, 0, 0.9, 0";
  for (int i = 0; i < 40; ++i) frame += i % 5 == 0 ? ", 1" : ", 0.1";
  return fmt::format(R"({{"Loop": "wrap", "Frames": [[{}], [{}]]}})", frame, frame);
}

void C3dFile(std::string_view bytes) {
  const auto read = ReadC3d(bytes, kFile);
  if (read) FindMarkerBodies(read->markers, kFile, {.up = C3dUp(read->up, read->is_up_negative)});
}

std::vector<std::string> C3dSeeds() {
  std::vector<std::string> seeds;
  for (const int machine : {testing::kIntel, testing::kDec, testing::kMips}) {
    for (const bool floats : {false, true}) seeds.push_back(testing::C3dWriter(machine, floats).Write());
  }
  return seeds;
}

constexpr const char* kAcclaimSkeleton =
    ":units\n angle deg\n:root\n order TX TY TZ RX RY RZ\n axis XYZ\n position 0 1 0\n orientation 0 0 9\n"
    ":bonedata\n begin\n id 1\n name upper\n direction 1 0 0\n length 2\n axis 0 0 90 XYZ\n dof rx ry rz\n end\n"
    " begin\n name lower\n direction 1 0 0\n length 3\n axis 0 0 0 XYZ\n end\n"
    ":hierarchy\n begin\n root upper\n upper lower\n end\n";

void AcclaimSkeletonFile(std::string_view bytes) {
  const auto read = ReadAcclaimSkeleton(bytes, kFile);
  if (read) ReadAcclaimMotion(":DEGREES\n1\nroot 1 2 3 4 5 6\n", *read, kFile);
}

void AcclaimMotionFile(std::string_view bytes) {
  static const AcclaimSkeleton skeleton = Required(ReadAcclaimSkeleton(kAcclaimSkeleton, kFile), "a seed");
  IsAcclaimMotion(bytes);
  const auto clip = ReadAcclaimMotion(bytes, skeleton, kFile);
  if (clip) MakeBody(*clip);
}

/// Two frames of AMASS, as NumPy packs them.
constexpr std::string_view kAmassInHexadecimal =
    "504b03041400000008000000210068d39d04520000006005000009001400706f7365732e6e70790100100060050000000000005200000000"
    "0000009bec17ea1b10c9c850c650ad9e925a9c5ca46ea5a06e9366a2aea3a09e965f54529498179f5f94920a12774bcc294e058a17672416"
    "a402f91a463a0a86a6669a3a0ab50a64022e8651300a46c12818a60000504b03041400000008000000210078b32618490000009800000009"
    "0014007472616e732e6e707901001000980000000000000049000000000000009bec17ea1b10c9c850c650ad9e925a9c5ca46ea5a06e9366"
    "a2aea3a09e965f54529498179f5f94920a12774bcc294e058a17672416a402f91a463a0ac69a3a0ab50a64032e061c0000504b0304140000"
    "00080000002100eb016ed34700000088000000130014006d6f6361705f6672616d65726174652e6e70790100100088000000000000004700"
    "0000000000009bec17ea1b10c9c850c650ad9e925a9c5ca46ea5a06e9366a1aea3a09e965f54529498179f5f94920a12774bcc294e058a17"
    "672416a402f91a9a3a0ab50a14012e063088730000504b030414000000080000002100e2f6377546000000840000000a00140067656e6465"
    "722e6e707901001000840000000000000046000000000000009bec17ea1b10c9c850c650ad9e925a9c5ca46ea5a06e136aa8aea3a09e965f"
    "54529498179f5f94920a12774bcc294e058a17672416a402f91a9a3a0ab50a1401ae3406060600504b010214031400000008000000210068"
    "d39d045200000060050000090000000000000000000000800100000000706f7365732e6e7079504b010214031400000008000000210078b3"
    "2618490000009800000009000000000000000000000080018d0000007472616e732e6e7079504b0102140314000000080000002100eb016e"
    "d347000000880000001300000000000000000000008001110100006d6f6361705f6672616d65726174652e6e7079504b0102140314000000"
    "080000002100e2f6377546000000840000000a000000000000000000000080019d01000067656e6465722e6e7079504b0506000000000400"
    "0400e70000001f0200000000";

std::string FromHexadecimal(std::string_view digits) {
  const auto value = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes += static_cast<char>(value(digits[i]) << 4 | value(digits[i + 1]));
  }
  return bytes;
}

void NpzFile(std::string_view bytes) {
  const auto arrays = ReadNpz(bytes, kFile);
  if (!arrays) return;
  const auto clip = ReadAmass(*arrays, kFile);
  if (clip) MakeBody(*clip);
}

void NpyFile(std::string_view bytes) {
  const auto array = ReadNpy(bytes, kFile);
  if (!array) return;
  std::string note;
  const auto joints = JointsOfArray(*array, std::nullopt, kFile, note);
  if (joints) (void)FindMarkerBodies(*joints, kFile);
}

std::string NpySeed() {
  static constexpr char kHead[] =
      "\x93NUMPY\x01\x00\x46\x00{'descr': '<f4', 'fortran_order': False, 'shape': (2, 26, 3), }";
  std::string bytes(kHead, sizeof kHead - 1);
  bytes.resize(80, ' ');
  bytes.back() = '\n';
  return bytes + std::string(4 * 2 * 26 * 3, '\x3f');
}

void MotiveFile(std::string_view bytes) {
  const auto markers = ReadMotiveCsv(bytes, kFile);
  if (markers) (void)FindMarkerBodies(*markers, kFile, {.up = MotiveUp()});
}

constexpr const char* kMotiveTake =
    "Format Version,1.23,Export Frame Rate,120,Length Units,Meters,Coordinate Space,Global\n\n,Type,Bone,Bone,Bone\n"
    ",Name,A:LUArm,A:LUArm,A:LUArm\n,ID,1,1,1\n,,Position,Position,Position\nFrame,Time (Seconds),X,Y,Z\n"
    "0,0.0,1,2,3\n1,0.0083,1,,3\n";

void AnglesFile(std::string_view bytes) {
  const auto motion = ReadOpenSimMotion(bytes, kFile);
  if (!motion) return;
  WriteOpenSimMotion(*motion, motion->poses.front(), "fuzzed");
}

std::string AnglesSeed() {
  const BodyMotion motion = testing::WavingMotion(2);
  return WriteOpenSimMotion(motion, motion.poses.front(), "seed");
}

void Map(std::string_view bytes) {
  const auto taught = ReadJointMapFile(bytes, kFile);
  if (!taught) return;
  static const Clip person = Required(ReadBvh(PersonBvh(), kFile), "a seed");
  const auto map = FindJointMap(person.skeleton, kFile, &*taught);
  if (!map) return;
  Required(ReadJointMapFile(WriteJointMapFile(person.skeleton, *map), kFile), "a map that was written is not read");
}

std::vector<std::string> MapSeeds() {
  const Clip person = Required(ReadBvh(PersonBvh(), kFile), "a seed");
  return {"roles:\n  left_shoulder: LeftArm\n  left_elbow: LeftForeArm\n",
          WriteJointMapFile(person.skeleton, Required(FindJointMap(person.skeleton, kFile), "a seed"))};
}

}  // namespace

std::vector<Target> MotionTargets() {
  return {
      {"bvh",
       Bvh,
       BvhSeeds,
       {"MOTION", "JOINT", "End Site", "Frames:", "Frame Time:", "Yposition", "nan", "inf", "1e308"}},
      {"gltf",
       Gltf,
       GltfSeeds,
       {"\"skins\"",
        "\"joints\"",
        "\"inverseBindMatrices\"",
        "\"sparse\"",
        "\"indices\"",
        "\"JOINTS_0\"",
        "\"WEIGHTS_0\"",
        "\"CUBICSPLINE\"",
        "\"STEP\"",
        "\"matrix\"",
        "\"normalized\"",
        "MAT4",
        "VEC4",
        "5121",
        "5123",
        "\"extensionsRequired\"",
        "data:application/octet-stream;base64,",
        "\"weights\"",
        "\"targets\"",
        "-1"}},
      {"trc", Trc, [] { return std::vector{WriteTrc(testing::WavingMotion(3), "seed")}; }, {"Units", "cm", "nan"}},
      {"motion-bids", Bids, [] { return std::vector{BidsSeed()}; }, {"n/a", "ORNT", "mm", "nan"}},
      {"joint-csv", Csv, [] { return std::vector{WriteJointCsv(testing::WavingMotion(3))}; }, {"nan", "1e400"}},
      {"rigid-targets", Targets17, [] { return std::vector{RigidRows()}; }, {"nan"}},
      {"deepmimic", DeepMimic, [] { return std::vector{DeepMimicText()}; }},
      {"c3d", C3dFile, C3dSeeds, {"POINT", "LABELS", "TRIAL", "ACTUAL_END_FIELD", "SCALE", "FRAMES"}},
      {"acclaim-skeleton",
       AcclaimSkeletonFile,
       [] { return std::vector<std::string>{kAcclaimSkeleton}; },
       {"dof", "tx", "nan"}},
      {"acclaim-motion",
       AcclaimMotionFile,
       [] { return std::vector<std::string>{":DEGREES\n1\nroot 1 2 3 4 5 6\nupper 7 8 9\n2\nupper 1 2 3\n"}; },
       {":RADIANS", "1e308", "nan"}},
      {"npz",
       NpzFile,
       [] { return std::vector{FromHexadecimal(kAmassInHexadecimal)}; },
       {"'shape': (", "<f8", "NUMPY"}},
      {"npy", NpyFile, [] { return std::vector{NpySeed()}; }, {"'shape': (", "<f8", "NUMPY", "17", "25"}},
      {"motive", MotiveFile, [] { return std::vector<std::string>{kMotiveTake}; }, {"Marker", "Local", "nan", ",,,"}},
      {"opensim", AnglesFile, [] { return std::vector{AnglesSeed()}; }, {"inDegrees=no", "ground", "-Z", "1e308"}},
      {"joint-map", Map, MapSeeds, {"hip_centre", "_End", "right_foot"}},
  };
}

}  // namespace etude::fuzz
