// Real files: assimp's own test models, some of them broken, and files damaged byte by byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "tests/engine/formats/gltf/small_glb.h"
#include "tests/support/random_clip.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::Dice;

const std::filesystem::path kModels = "/usr/share/assimp/models";

std::string Bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Result<GltfContent> ReadModel(const std::string& name, const std::string& bytes) {
  return ReadGltf(bytes, name, [&](const std::string& uri) -> Result<std::string> {
    const std::filesystem::path beside = (kModels / name).parent_path() / uri;
    if (!std::filesystem::exists(beside)) return Fail({uri}, "no such file");
    return Bytes(beside);
  });
}

/// Numbers of joints, meshes, triangles, clips.
struct Counts {
  std::size_t joints = 0, meshes = 0, triangles = 0, clips = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Counts& counts) {
    return out << counts.joints << " joints, " << counts.meshes << " meshes, " << counts.triangles << " triangles, "
               << counts.clips << " clips";
  }
};

Counts CountsOf(const GltfContent& content) {
  Counts counts{content.character.skeleton.joints.size(), content.character.meshes.size(), 0, content.clips.size()};
  for (const SkinnedMesh& mesh : content.character.meshes) counts.triangles += mesh.triangles.size();
  return counts;
}

// clang-format off
const std::map<std::string, Counts> kRead = {
    {"glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", {82, 115, 121496, 0}},
    {"glTF2/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", {2, 1, 12, 0}},
    {"glTF2/BoxTexcoords-glTF/boxTexcoords.gltf", {3, 1, 12, 0}},
    {"glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", {2, 1, 12, 0}},
    {"glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", {2, 1, 12, 0}},
    {"glTF2/BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf", {2, 1, 12, 0}},
    {"glTF2/BoxTextured-glTF/BoxTextured.gltf", {2, 1, 12, 0}},
    {"glTF2/ClearCoat-glTF/ClearCoatTest.gltf", {33, 27, 37116, 0}},
    {"glTF2/cameras/Cameras.gltf", {3, 1, 2, 0}},
    {"glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", {1, 1, 12, 0}},
    {"glTF2/issue_3269/texcoord_crash.gltf", {5, 5, 10, 0}},
    {"glTF2/simple_skin/simple_skin.gltf", {3, 1, 8, 1}},
    {"glTF2/textureTransform/TextureTransformTest.gltf", {12, 12, 24, 0}},
    {"glTF2/draco/2CylinderEngine.gltf", {82, 0, 0, 0}},  // without its compressed meshes
    // The damage is in a part that is not read.
    {"glTF2/wrongTypes/badExtension.gltf", {2, 1, 12, 0}},
    {"glTF2/wrongTypes/badObject.gltf", {2, 1, 12, 0}},
    {"glTF2/wrongTypes/badString.gltf", {2, 1, 12, 0}},
    {"glTF2/wrongTypes/badUint.gltf", {2, 1, 12, 0}},
};

/// Files in assimp's packages since 5.4.
const std::map<std::string, Counts> kReadSince54 = {
    {"glTF2/simple_skin/quad_skin.glb", {22, 1, 2, 0}},
};

const std::map<std::string, std::string> kRefused = {
    {"glTF/BoxTextured-glTF-Binary/BoxTextured.glb", "found GLB version 1; allowed: 2"},
    {"glTF/BoxTextured-glTF-Embedded/BoxTextured.gltf", "asset.version: found '1.0'; allowed: 2.0"},
    {"glTF/BoxTextured-glTF-MaterialsCommon/BoxTextured.gltf", "asset.version: found '1.0'; allowed: 2.0"},
    {"glTF/BoxTextured-glTF/BoxTextured.gltf", "asset.version: found '1.0'; allowed: 2.0"},
    {"glTF/CesiumMilkTruck/CesiumMilkTruck.gltf", "not glTF 2.0: \"asset\" object not found"},
    {"glTF/IncorrectVertexArrays/Cube_v1.gltf", "asset.version: found '1.0'; allowed: 2.0"},
    {"glTF/TwoBoxes/TwoBoxes.gltf", "asset.version: found '1.0'; allowed: 2.0"},
    {"glTF2/BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf", "extensionsRequired: found 'KHR_technique_webgl'"},
    {"glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "meshes[0].primitives[0].POSITION (accessors[2]): found -inf in element 0"},
    {"glTF2/IncorrectVertexArrays/Cube.gltf", "meshes[1].primitives[0]: found 35 corners; allowed: multiples of 3"},
    {"glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf", "indices: found vertex 65535 in element 0; allowed: 0 to 23"},
    {"glTF2/IndexOutOfRange/IndexOutOfRange.gltf", "indices: found vertex 255 in element 0; allowed: 0 to 23"},
    {"glTF2/MissingBin/BoxTextured.gltf", "BoxTextured0.bin: no such file"},
    {"glTF2/RecursiveNodes/RecursiveNodes.gltf", "nodes[0]: the node is its own ancestor; allowed: a tree of nodes"},
    {"glTF2/SchemaFailures/sceneWrongType.gltf", "BoxTextured0.bin: no such file"},
    {"glTF2/TestNoRootNode/NoScene.gltf", "nodes: found none; allowed: at least one"},
    {"glTF2/TestNoRootNode/SceneWithoutNodes.gltf", "nodes: found none; allowed: at least one"},
    {"glTF2/wrongTypes/badArray.gltf", "meshes[0].primitives: found none; allowed: at least one"},
    {"glTF2/wrongTypes/badNumber.gltf", "not glTF 2.0: 'index' property is missing in NormalTextureInfo"},
};
// clang-format on

/// Returns the counts of assimp's sixteen files, one per drawing mode; lines and points have no surface.
Counts PrimitiveMode(int number) {
  const bool has_surface = (number >= 4 && number <= 6) || number >= 11;
  return has_surface ? Counts{1, 1, 2, 0} : Counts{1, 0, 0, 0};
}

TEST(GltfModels, OfAssimpAreReadOrRefusedWithAReason) {
  ASSERT_TRUE(std::filesystem::exists(kModels)) << "not installed: package assimp-testmodels";
  std::map<std::string, Counts> to_read = kRead;
  for (int i = 0; i < 16; ++i) {
    to_read[fmt::format("glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_{:02}.gltf", i)] =
        PrimitiveMode(i);
  }
  for (const auto& [name, counts] : kReadSince54) {
    if (std::filesystem::exists(kModels / name)) to_read[name] = counts;
  }
  std::size_t found = 0;
  for (const char* folder : {"glTF", "glTF2"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kModels / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".gltf" && extension != ".glb") continue;
      ++found;
      const std::string name = std::filesystem::relative(entry.path(), kModels);
      SCOPED_TRACE(name);
      const auto content = ReadModel(name, Bytes(entry.path()));
      if (const auto expected = to_read.find(name); expected != to_read.end()) {
        ASSERT_TRUE(content) << ToString(content.error());
        testing::ExpectSane(*content);
        EXPECT_EQ(CountsOf(*content), expected->second);
      } else {
        ASSERT_TRUE(kRefused.contains(name)) << "a file in neither list";
        EXPECT_THAT(testing::Refusal(content), ::testing::HasSubstr(kRefused.at(name)));
      }
    }
  }
  EXPECT_EQ(found, to_read.size() + kRefused.size());
}

std::string MutatedModel(std::string bytes, Dice& dice) {
  constexpr std::string_view kJson = "{}[]:,-+.eE0123456789\"\\ntf\x00\x7F\x80\xFF";
  for (std::uint32_t i = 0; i <= dice.Below(3); ++i) {
    const std::size_t at = dice.Below(bytes.size());
    const std::size_t length = dice.Below(20);
    switch (dice.Below(6)) {
      case 0:
        bytes[at] = static_cast<char>(dice.Below(256));
        break;
      case 1:
        bytes[at] = kJson[dice.Below(kJson.size())];
        break;
      case 2:
        bytes.insert(at, 1, kJson[dice.Below(kJson.size())]);
        break;
      case 3:
        bytes.insert(at, bytes.substr(dice.Below(bytes.size()), length));
        break;
      case 4:
        for (std::size_t k = at; k < std::min(at + length, bytes.size()); ++k) bytes[k] = '\xFF';
        break;
      default:
        bytes.erase(at, length);
    }
    if (bytes.empty()) bytes = "x";
  }
  return bytes;
}

struct Outcomes {
  int read = 0;
  int refused = 0;

  void Count(const Result<GltfContent>& content) {
    if (!content) {
      ++refused;
      EXPECT_FALSE(content.error().message.empty());
      EXPECT_EQ(ToString(content.error()).find('\n'), std::string::npos);
      return;
    }
    ++read;
    testing::ExpectSane(*content);
  }
};

TEST(GltfModels, NeverCrashOrGiveNonsenseWhenBytesOfARealOneChange) {
  ASSERT_TRUE(std::filesystem::exists(kModels)) << "not installed: package assimp-testmodels";
  Dice dice(4);
  for (const std::string name :
       {"glTF2/simple_skin/simple_skin.gltf", "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
        "glTF2/BoxTextured-glTF/BoxTextured.gltf", "glTF2/IncorrectVertexArrays/Cube.gltf",
        "glTF2/cameras/Cameras.gltf", "glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf",
        "glTF/TwoBoxes/TwoBoxes.gltf"}) {
    SCOPED_TRACE(name);
    const std::string bytes = Bytes(kModels / name);
    Outcomes outcomes;
    for (int i = 0; i < 300; ++i) {
      outcomes.Count(ReadModel(name, MutatedModel(bytes, dice)));
      if (::testing::Test::HasFailure()) FAIL() << "in mutation " << i;
    }
    EXPECT_GT(outcomes.refused, 10);
  }
}

}  // namespace
}  // namespace etude
