#include "io/clips/fbx.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/formats/gltf/gltf.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns an FBX text with hips and an arm, which is their child and has a pre-rotation. The arm's translation,
/// rotation and scale have `keys` keys each within one second, in which the arm moves from x = 10 to x = 20.
/// `settings` are properties of the file.
std::string ArmWithKeys(int keys, const std::string& settings = "") {
  std::string objects, links;
  const auto model = [&](int id, const char* name, const char* more) {
    objects += fmt::format("Model: {}, \"Model::{}\", \"LimbNode\" {{\nVersion: 232\nProperties70: {{\n{}}}\n}}\n", id,
                           name, more);
  };
  model(10, "Hips", "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,90,0\n");
  model(11, "Arm",
        "P: \"RotationActive\", \"bool\", \"\", \"\",1\nP: \"PreRotation\", \"Vector3D\", \"Vector\", \"\",0,90,0\n"
        "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",10,0,0\n");
  objects += "AnimationStack: 1, \"AnimStack::Move\", \"\" {\n}\nAnimationLayer: 2, \"AnimLayer::Base\", \"\" {\n}\n";
  links += "C: \"OO\",10,0\nC: \"OO\",11,10\nC: \"OO\",2,1\n";
  // Each of the three properties has three curves.
  constexpr std::int64_t kSecond = 46'186'158'000;
  std::vector<std::int64_t> times;
  for (int k = 0; k < keys; ++k) times.push_back(kSecond * k / (keys - 1));
  int id = 100;
  for (const auto& [property, name, rest] :
       {std::tuple("T", "Lcl Translation", 0.0), {"R", "Lcl Rotation", 0.0}, {"S", "Lcl Scaling", 1.0}}) {
    const int node = id++;
    objects += fmt::format("AnimationCurveNode: {}, \"AnimCurveNode::{}\", \"\" {{\n}}\n", node, property);
    links += fmt::format("C: \"OO\",{},2\nC: \"OP\",{},11, \"{}\"\n", node, node, name);
    for (const char axis : {'X', 'Y', 'Z'}) {
      std::vector<double> values;
      for (int k = 0; k < keys; ++k) {
        values.push_back(*property == 'T' && axis == 'X' ? 10 + 10.0 * k / (keys - 1) : rest);
      }
      objects += fmt::format(
          "AnimationCurve: {}, \"AnimCurve::\", \"\" {{\nDefault: 0\nKeyVer: 4008\nKeyTime: *{} {{\na: {}\n}}\n"
          "KeyValueFloat: *{} {{\na: {}\n}}\nKeyAttrFlags: *1 {{\na: 24836\n}}\nKeyAttrDataFloat: *4 {{\na: "
          "0,0,0,0\n}}\nKeyAttrRefCount: *1 {{\na: {}\n}}\n}}\n",
          id, keys, fmt::join(times, ","), keys, fmt::join(values, ","), keys);
      links += fmt::format("C: \"OP\",{},{}, \"d|{}\"\n", id++, node, axis);
    }
  }
  return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXVersion: 7400\n}\nGlobalSettings: {\nVersion: "
         "1000\nProperties70: {\n" +
         settings + "}\n}\nObjects: {\n" + objects + "}\nConnections: {\n" + links + "}\n";
}

TEST(Fbx, JointsWithPivotsKeepTheirMotionWhateverTheNumberOfKeys) {
  // For 2048 keys of three kinds, a product in 32 bits overflows to 0.
  for (const int keys : {31, 2047, 2048, 2049}) {
    ASSERT_OK(motion, ReadFbx(ArmWithKeys(keys), "a.fbx"));
    ASSERT_OK(content, ReadGltf(motion->glb, "a.fbx", nullptr));
    ASSERT_EQ(content->clips.size(), 1u) << keys;
    const Clip& clip = content->clips[0];
    const auto arm = static_cast<std::size_t>(clip.skeleton.Find("Arm"));
    const glm::dvec3 way = clip.frames.back()[arm].translation - clip.frames.front()[arm].translation;
    EXPECT_NEAR(glm::length(way), 0.1, 1e-3) << keys << " keys: 10 cm";
  }
}

// The axes that a file calls right, up and front (the FBX SDK's coordinate, up and front axis) become X, Y and Z. In
// the last frame, the arm is at (20, 90, 0) cm.
TEST(Fbx, AllThreeAxesOfAFileCount) {
  const auto arm_m = [](const std::array<int, 6>& axes) {
    std::string settings;
    constexpr std::array kNames = {"UpAxis", "UpAxisSign", "FrontAxis", "FrontAxisSign", "CoordAxis", "CoordAxisSign"};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      settings += fmt::format("P: \"{}\", \"int\", \"Integer\", \"\",{}\n", kNames[i], axes[i]);
    }
    const auto motion = ReadFbx(ArmWithKeys(31, settings), "a.fbx");
    EXPECT_TRUE(motion);
    const auto content = ReadGltf(motion->glb, "a.fbx", nullptr);
    const Clip& clip = content->clips.at(0);
    std::vector<GlobalTransform> globals;
    ComputeGlobals(clip.skeleton, clip.frames.back(), globals);
    return globals.at(static_cast<std::size_t>(clip.skeleton.Find("Arm"))).position;
  };
  using V = glm::dvec3;
  for (const auto& [axes, place] : {std::pair(std::array{1, 1, 2, 1, 0, 1}, V(.2, .9, 0)),  // Maya
                                    {{2, 1, 1, -1, 0, 1}, V(.2, 0, -.9)},                   // 3ds Max
                                    {{2, 1, 1, 1, 0, -1}, V(-.2, 0, .9)},
                                    {{2, 1, 0, 1, 1, 1}, V(.9, 0, .2)},
                                    {{0, 1, 1, 1, 2, 1}, V(0, .2, .9)},
                                    {{1, -1, 2, -1, 0, 1}, V(.2, -.9, 0)},
                                    {{1, 1, 2, -1, 0, -1}, V(-.2, .9, 0)},
                                    // Left-handed, or not three axes: only the up axis counts.
                                    {{1, 1, 2, -1, 0, 1}, V(.2, .9, 0)},
                                    {{2, 1, 2, 1, 0, 1}, V(.2, 0, -.9)}}) {
    EXPECT_LT(glm::distance(arm_m(axes), place), 1e-5) << axes[0] << axes[2] << axes[4];
  }
}

}  // namespace
}  // namespace etude
