#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/formats/gltf/small_glb.h"
#include "tests/support/replaced.h"

namespace etude {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using testing::Floats;
using testing::Glb;
using testing::kSmallGltf;
using testing::RawBytes;
using testing::Read;
using testing::Replaced;
using testing::SmallBinary;

using Triangle = std::array<std::uint32_t, 3>;

SkinnedMesh OnlyMesh(const GltfContent& content) {
  EXPECT_EQ(content.character.meshes.size(), 1u);
  return content.character.meshes.empty() ? SkinnedMesh{} : content.character.meshes[0];
}

/// Reads a mesh of one primitive with these attributes on one node; "buffers" is sized to fit.
GltfContent ReadMesh(const std::string& primitive, const std::string& accessors, const std::string& views,
                     const std::string& binary, const std::string& node = "") {
  return Read(Glb(R"({"asset":{"version":"2.0"},"nodes":[{"name":"Node","mesh":0)" + node +
                      R"(}],"meshes":[{"primitives":[{)" + primitive + R"(}]}],"accessors":[)" + accessors +
                      R"(],"bufferViews":[)" + views + R"(],"buffers":[{"byteLength":)" +
                      std::to_string(binary.size()) + "}]}",
                  binary));
}

/// Returns a square of four corners without indices, in this mode.
SkinnedMesh Square(int mode, const std::string& node = "") {
  return OnlyMesh(ReadMesh(R"("attributes":{"POSITION":0,"NORMAL":1},"mode":)" + std::to_string(mode),
                           R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                              {"bufferView":0,"byteOffset":12,"componentType":5126,"count":4,"type":"VEC3"})",
                           R"({"buffer":0,"byteLength":96,"byteStride":24})",
                           Floats({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 2}), node));
}

TEST(GltfMesh, HasItsMaterialBindingsAndVertices) {
  const GltfContent content = Read(testing::SmallGlb());
  ASSERT_EQ(content.character.materials.size(), 1u);
  EXPECT_EQ(content.character.materials[0].name, "Fur");
  EXPECT_EQ(content.character.materials[0].colour, glm::dvec3(0.5, 0.25, 0.125));
  const SkinnedMesh mesh = OnlyMesh(content);
  EXPECT_EQ(mesh.name, "Coat");
  ASSERT_EQ(mesh.bindings.size(), 2u);
  EXPECT_EQ(mesh.bindings[1].joint, 1);
  EXPECT_EQ(mesh.bindings[1].inverse_bind[3], glm::dvec4(0, -1.5, 0, 1));
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[1].position, glm::dvec3(1, 1, 0));
  EXPECT_THAT(mesh.vertices[1].bindings, ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(mesh.vertices[1].weights, ElementsAre(0.5, 0.5, 0, 0));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(GltfMesh, FollowsItsBonesNotItsNode) {
  const GltfContent moved = Read(
      Glb(Replaced(kSmallGltf, R"("mesh":0,"skin":0)", R"("mesh":0,"skin":0,"translation":[5,5,5])"), SmallBinary()));
  std::vector<GlobalTransform> globals;
  ComputeGlobals(moved.character.skeleton, moved.clips.at(0).frames.at(1), globals);  // bent forward by 90°
  const DeformedMesh deformed = Deform(OnlyMesh(moved), globals);
  EXPECT_LT(glm::length(deformed.positions[0] - glm::dvec3(0, 1, 0)), 1e-7);      // bound to the hips
  EXPECT_LT(glm::length(deformed.positions[2] - glm::dvec3(0, 1.5, 0.5)), 1e-7);  // 0.5 above the spine, now 0.5 ahead
}

TEST(GltfMesh, WithoutASkinHangsOnItsNode) {
  const SkinnedMesh mesh = Square(4 + 1);
  ASSERT_EQ(mesh.bindings.size(), 1u);
  EXPECT_EQ(mesh.bindings[0].joint, 0);
  EXPECT_EQ(mesh.bindings[0].inverse_bind, glm::dmat4(1));
  for (const auto& vertex : mesh.vertices) EXPECT_THAT(vertex.weights, ElementsAre(1, 0, 0, 0));
}

TEST(GltfMesh, WithoutANameHasThatOfItsJoint) {
  EXPECT_EQ(Square(5).name, "Node");
  const std::string text =
      Replaced(Replaced(kSmallGltf, R"("name":"Coat",)", ""), R"("mesh":0,"skin":0)", R"("mesh":0)");
  EXPECT_EQ(OnlyMesh(Read(Glb(Replaced(text, R"("name":"Body",)", ""), SmallBinary()))).name, "node_2");
}

TEST(GltfMesh, CutsStripsAndFansIntoTriangles) {
  EXPECT_THAT(Square(5).triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}));
  EXPECT_THAT(Square(6).triangles, ElementsAre(Triangle{1, 2, 0}, Triangle{2, 3, 0}));
}

TEST(GltfMesh, OfPointsOrLinesIsPassedOver) {
  for (int mode = 0; mode <= 3; ++mode) {
    const GltfContent content = ReadMesh(R"("attributes":{"POSITION":0},"mode":)" + std::to_string(mode),
                                         R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})",
                                         R"({"buffer":0,"byteLength":36})", Floats({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    EXPECT_TRUE(content.character.meshes.empty());
  }
}

TEST(GltfMesh, HasUnitNormals) {
  // The last normal of the square has length 2 in the file.
  for (const auto& vertex : Square(5).vertices) EXPECT_EQ(vertex.normal, glm::dvec3(0, 0, 1));
}

TEST(GltfMesh, WithoutNormalsGetsFlatOnes) {
  // Two triangles that share an edge, at a right angle.
  const SkinnedMesh mesh = OnlyMesh(
      ReadMesh(R"("attributes":{"POSITION":0},"indices":1)",
               R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                  {"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"})",
               R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":6})",
               Floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + RawBytes<std::uint8_t>({0, 1, 2, 0, 3, 1, 0, 0})));
  ASSERT_EQ(mesh.vertices.size(), 6u);
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{3, 4, 5}));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(mesh.vertices[i].normal, glm::dvec3(0, 0, 1));
  for (int i = 3; i < 6; ++i) EXPECT_EQ(mesh.vertices[i].normal, glm::dvec3(0, 1, 0));
}

TEST(GltfMesh, WithoutAMaterialIsWhite) {
  const GltfContent content =
      Read(Glb(Replaced(kSmallGltf, R"("indices":3,"material":0)", R"("indices":3)"), SmallBinary()));
  ASSERT_EQ(content.character.materials.size(), 2u);
  EXPECT_EQ(OnlyMesh(content).material, 1);
  EXPECT_EQ(content.character.materials[1].colour, glm::dvec3(1));
}

TEST(GltfMesh, OnAMirroredNodeKeepsItsOutside) {
  EXPECT_THAT(Square(5, R"(,"scale":[-1,1,1])").triangles, ElementsAre(Triangle{0, 2, 1}, Triangle{1, 2, 3}));
}

/// Returns the small body with eight joints per vertex and the same weights for all three vertices.
SkinnedMesh WithTwoSets(std::initializer_list<float> first, std::initializer_list<float> second) {
  std::string json = Replaced(kSmallGltf, R"("WEIGHTS_0":2)", R"("WEIGHTS_0":2,"JOINTS_1":7,"WEIGHTS_1":8)");
  json = Replaced(json, R"("count":3,"type":"VEC4"}],)",
                  R"("count":3,"type":"VEC4"},{"bufferView":7,"componentType":5121,"count":3,"type":"VEC4"},
                     {"bufferView":8,"componentType":5126,"count":3,"type":"VEC4"}],)");
  json = Replaced(json, R"("byteOffset":244,"byteLength":48})",
                  R"("byteOffset":244,"byteLength":48},{"buffer":0,"byteOffset":292,"byteLength":12},
                     {"buffer":0,"byteOffset":304,"byteLength":48})");
  json = Replaced(json, R"("byteLength":292)", R"("byteLength":352)");
  std::string binary = SmallBinary();
  const std::string weights = Floats(first) + Floats(first) + Floats(first);
  binary.replace(testing::kWeights, weights.size(), weights);
  binary +=
      RawBytes<std::uint8_t>({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}) + Floats(second) + Floats(second) + Floats(second);
  return OnlyMesh(Read(Glb(json, binary)));
}

TEST(GltfMesh, KeepsTheFourGreatestOfManyWeights) {
  const SkinnedMesh mesh = WithTwoSets({0.1f, 0.2f, 0.05f, 0.15f}, {0.3f, 0.2f, 0, 0});
  const auto& vertex = mesh.vertices.at(0);
  EXPECT_THAT(vertex.weights, ElementsAre(DoubleNear(0.3 / 0.85, 1e-7), DoubleNear(0.2 / 0.85, 1e-7),
                                          DoubleNear(0.2 / 0.85, 1e-7), DoubleNear(0.15 / 0.85, 1e-7)));
  EXPECT_THAT(vertex.bindings, ElementsAre(1, 0, 1, 0));
}

TEST(GltfMesh, LeavesAloneAFirstSetThatIsEnough) {
  const SkinnedMesh mesh = WithTwoSets({0.25f, 0.75f, 0, 0}, {0, 0, 0, 0});
  EXPECT_THAT(mesh.vertices.at(1).weights, ElementsAre(0.25, 0.75, 0, 0));
  EXPECT_THAT(mesh.vertices.at(1).bindings, ElementsAre(0, 1, 0, 0));
}

TEST(GltfMesh, MakesWeightsSumToOne) {
  std::string binary = SmallBinary();
  const std::string weights = Floats({2, 0, 0, 0, 1, 3, 0, 0, 0, 0, 0, 0});
  binary.replace(testing::kWeights, weights.size(), weights);
  const SkinnedMesh mesh = OnlyMesh(Read(Glb(std::string(kSmallGltf), binary)));
  EXPECT_THAT(mesh.vertices[0].weights, ElementsAre(1, 0, 0, 0));
  EXPECT_THAT(mesh.vertices[1].weights, ElementsAre(0.25, 0.75, 0, 0));
  EXPECT_THAT(mesh.vertices[2].weights, ElementsAre(1, 0, 0, 0));  // without weight: bound to the skin's first joint
  EXPECT_THAT(mesh.vertices[2].bindings, ElementsAre(0, 0, 0, 0));
}

TEST(GltfMesh, UnderstandsSparseAccessors) {
  // All zero except elements 1 and 2.
  const SkinnedMesh mesh =
      OnlyMesh(ReadMesh(R"("attributes":{"POSITION":0})",
                        R"({"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":2,
                   "indices":{"bufferView":0,"componentType":5123},"values":{"bufferView":1}}})",
                        R"({"buffer":0,"byteLength":4},{"buffer":0,"byteOffset":4,"byteLength":24})",
                        RawBytes<std::uint16_t>({1, 2}) + Floats({4, 0, 0, 0, 5, 0})));
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0].position, glm::dvec3(0, 0, 0));
  EXPECT_EQ(mesh.vertices[1].position, glm::dvec3(4, 0, 0));
  EXPECT_EQ(mesh.vertices[2].position, glm::dvec3(0, 5, 0));
}

TEST(GltfMesh, UnderstandsQuantisedPositions) {
  const SkinnedMesh mesh = OnlyMesh(ReadMesh(R"("attributes":{"POSITION":0})",
                                             R"({"bufferView":0,"componentType":5122,"count":3,"type":"VEC3"})",
                                             R"({"buffer":0,"byteLength":24,"byteStride":8})",
                                             RawBytes<std::int16_t>({0, 0, -300, 0, 1, 0, 0, 0, 0, 200, 0, 0})));
  EXPECT_EQ(mesh.vertices.at(0).position, glm::dvec3(0, 0, -300));
  EXPECT_EQ(mesh.vertices.at(2).position, glm::dvec3(0, 200, 0));
}

TEST(GltfMesh, IsReadFromDataWithinTheText) {
  // Nine floats; the fourth and the eighth are 1.
  const std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
      "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
      "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const SkinnedMesh mesh = OnlyMesh(Read(text));
  EXPECT_EQ(mesh.vertices.at(1).position, glm::dvec3(1, 0, 0));
  EXPECT_EQ(mesh.vertices.at(2).position, glm::dvec3(0, 1, 0));
}

TEST(GltfMesh, IsReadFromAFileBesideTheText) {
  const std::string text =
      Replaced(kSmallGltf, R"("byteLength":292)", R"("byteLength":292,"uri":"parts/my%20bear.bin")");
  std::vector<std::string> asked;
  const GltfContent content = Read(text, [&](const std::string& uri) -> Result<std::string> {
    asked.push_back(uri);
    return SmallBinary();
  });
  EXPECT_THAT(asked, ElementsAre("parts/my bear.bin"));
  EXPECT_EQ(OnlyMesh(content).vertices.size(), 3u);
}

TEST(GltfMesh, IsReadWithoutItsTextures) {
  const std::string json =
      Replaced(kSmallGltf, R"("animations")", R"("images":[{"uri":"fur.png"},{"uri":"/etc/passwd.JPG"},
          {"bufferView":0,"mimeType":"image/png"}],"textures":[{"source":0}],"animations")");
  const GltfContent content = Read(Glb(json, SmallBinary()), [](const std::string& uri) -> Result<std::string> {
    ADD_FAILURE() << "asked for " << uri;
    return "";
  });
  EXPECT_EQ(OnlyMesh(content).vertices.size(), 3u);
}

}  // namespace
}  // namespace etude
