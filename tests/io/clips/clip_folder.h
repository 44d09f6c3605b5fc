#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/files/files.h"
#include "io/files/temporary_folder.h"

namespace etude {

/// A test with its own folder for motion files.
class ClipFolder : public ::testing::Test {
 protected:
  std::string Write(const std::string& name, std::string_view bytes) {
    const std::filesystem::path path = folder_.path() / name;
    EXPECT_TRUE(WriteFileAtomically(path, bytes));
    return path.string();
  }
  std::string In(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_ = *TemporaryFolder::Make("clips-test");
};

/// A valid file with too few joints to be understood as a body.
inline constexpr std::string_view kTwoJoints = R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Chest
  {
    OFFSET 0 10 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 5 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.1
0 0 0 0 0 0 0 0 0
1 0 0 0 0 0 0 0 0
)";

/// Returns a glTF with two nodes and no animation; `buffers` is inserted.
inline std::string GltfWith(const std::string& buffers) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
             "nodes": [{"name": "Hips", "children": [1]}, {"name": "Chest"}])" +
         buffers + "}";
}

/// Returns a glTF that moves "Chest" for one second, under two names; `uri` holds the numbers.
inline std::string GltfWithAnimations(const std::string& uri) {
  const std::string animation = R"("channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}],
                                   "samplers": [{"input": 0, "output": 1}])";
  return GltfWith(R"(, "buffers": [{"uri": ")" + uri + R"(", "byteLength": 32}],
    "bufferViews": [{"buffer": 0, "byteLength": 8}, {"buffer": 0, "byteOffset": 8, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                  {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"}],
    "animations": [{"name": "Armature|Jump", )" +
                  animation + R"(}, {"name": "Armature|Walk", )" + animation + "}]");
}

/// Returns the content of the animations' buffer: times 0 and 1, positions (0, 0, 0) and (0, 1, 0).
inline std::string AnimationBytes() {
  const float numbers[] = {0, 1, 0, 0, 0, 0, 1, 0};
  return {reinterpret_cast<const char*>(numbers), sizeof(numbers)};
}

}  // namespace etude
