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
#include "engine/formats/point_table.h"
#include "engine/formats/rigid_targets.h"
#include "engine/formats/trc.h"
#include "engine/motion/character.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/markers.h"
#include "engine/retargeting/opensim_motion.h"
#include "engine/retargeting/to_body.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/engine/streams/small_files.h"
#include "tests/fuzz/readers/target.h"
#include "tests/support/c3d_writer.h"
#include "tests/support/person.h"
#include "tests/support/random_clip.h"

namespace etude::fuzz {
namespace {

/// Finds the roles of a clip and makes the body's motion, as is done for clips of every format.
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

/// Returns two rotating joints and an end site, in `frames` frames.
std::string SmallBvh(int frames) {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 90 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
      "Yrotation\n\tJOINT LeftUpLeg\n\t{\n\t\tOFFSET 10 0 0\n\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n\t\tEnd "
      "Site\n\t\t{\n\t\t\tOFFSET 0 -40 0\n\t\t}\n\t}\n}\nMOTION\n";
  text += fmt::format("Frames: {}\nFrame Time: 0.0333333\n", frames);
  for (int t = 0; t < frames; ++t) text += fmt::format("0 90 {} 0 0 {} 5 -{} 0\n", t, 10 * t, t);
  return text;
}

std::string PersonBvh() { return WriteBvh(testing::AtRest(testing::PersonSkeleton(), 2)); }

std::vector<std::string> BvhSeeds() { return {SmallBvh(1), SmallBvh(4), PersonBvh()}; }

void Gltf(std::string_view bytes) {
  // Every file that it refers to exists, with wrong content.
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

/// Input: the channels, a form feed, the rows.
void Bids(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\f'), bytes.size());
  const std::string_view rows = bytes.substr(std::min(end + 1, bytes.size()));
  if (const auto markers = ReadMotionBids(rows, bytes.substr(0, end), {30}, {kFile, kFile})) FindMarkerBodies(*markers, kFile);
}

std::string BidsSeed() {
  const BidsFiles files = WriteMotionBids(testing::WavingMotion(3), "seed", "1");
  return files[1].second + "\f" + files[0].second;
}

void Csv(std::string_view bytes) { ReadJointCsv(bytes, kFile); }
void Table(std::string_view bytes) {
  if (IsPointTable(bytes)) ReadPointTable(bytes, kFile);
}
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

std::string AmassSeed() {
  return WriteNpz({{"poses", {.shape = {2, 72}, .values = std::vector<double>(144, 0.1)}},
                   {"trans", {.shape = {2, 3}, .values = std::vector<double>(6, 1)}},
                   {"mocap_framerate", {.shape = {}, .values = {30}}}},
                  {{"gender", {"female"}}});
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
  const auto joints = JointsOfArray(*array, std::nullopt, kFile);
  if (joints) (void)FindMarkerBodies(joints->motion, kFile);
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
      {"gltf", Gltf, GltfSeeds,
       testing::Parts(
           R"("skins"^"joints"^"inverseBindMatrices"^"sparse"^"indices"^"JOINTS_0"^"WEIGHTS_0"^"CUBICSPLINE"^)"
           R"("STEP"^"matrix"^"normalized"^MAT4^VEC4^5121^5123^"extensionsRequired"^)"
           R"(data:application/octet-stream;base64,^"weights"^"targets"^-1)")},
      {"trc", Trc, [] { return std::vector{WriteTrc(testing::WavingMotion(3), "seed")}; }, {"Units", "cm", "nan"}},
      {"motion-bids", Bids, [] { return std::vector{BidsSeed()}; }, {"n/a", "ORNT", "mm", "nan"}},
      {"point-table",
       Table,
       [] { return std::vector<std::string>{"frame,time,a_x,a_y,a_z,b_x,b_y,b_z,cX,cY,cZ\n0,0,1,2,3,4,5,6,7,8,9\n"}; },
       {"nan", "_mm", "time (ms)", "person"}},
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
      {"npz", NpzFile, [] { return std::vector{AmassSeed()}; }, {"'shape': (", "<f8", "NUMPY"}},
      {"npy", NpyFile, [] { return std::vector{NpySeed()}; }, {"'shape': (", "<f8", "NUMPY", "17", "25"}},
      {"motive", MotiveFile, [] { return std::vector<std::string>{kMotiveTake}; }, {"Marker", "Local", "nan", ",,,"}},
      {"opensim", AnglesFile, [] { return std::vector{AnglesSeed()}; }, {"inDegrees=no", "ground", "-Z", "1e308"}},
      {"joint-map", Map, MapSeeds, {"hip_centre", "_End", "right_foot"}},
  };
}

}  // namespace etude::fuzz
