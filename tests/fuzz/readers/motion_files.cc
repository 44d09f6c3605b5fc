#include <fmt/format.h>

#include "engine/formats/bvh.h"
#include "engine/formats/deepmimic.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/rigid_targets.h"
#include "engine/formats/trc.h"
#include "engine/motion/character.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/to_body.h"
#include "tests/engine/streams/small_files.h"
#include "tests/fuzz/readers/target.h"
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
  RequireRoundTrip(
      bytes, [](std::string_view text) { return ReadTrc(text, kFile); },
      [](const MarkerMotion& motion) { return WriteTrc(motion, kFile); });
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
      {"joint-csv", Csv, [] { return std::vector{WriteJointCsv(testing::WavingMotion(3))}; }, {"nan", "1e400"}},
      {"rigid-targets", Targets17, [] { return std::vector{RigidRows()}; }, {"nan"}},
      {"deepmimic", DeepMimic, [] { return std::vector{DeepMimicText()}; }},
      {"joint-map", Map, MapSeeds, {"hip_centre", "_End", "right_foot"}},
  };
}

}  // namespace etude::fuzz
