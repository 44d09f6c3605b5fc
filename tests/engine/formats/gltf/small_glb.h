#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>

#include "engine/formats/gltf/gltf.h"
#include "tests/support/random_clip.h"

namespace etude::testing {

template <typename T>
std::string RawBytes(std::initializer_list<T> values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), std::data(values), bytes.size());
  return bytes;
}

inline std::string Floats(std::initializer_list<float> values) { return RawBytes(values); }

inline std::string Glb(std::string json, std::string binary = "") {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto size = [](std::size_t bytes) { return RawBytes({static_cast<std::uint32_t>(bytes)}); };
  std::string chunks = size(json.size()) + "JSON" + json;
  if (!binary.empty()) chunks += size(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + RawBytes<std::uint32_t>({2}) + size(12 + chunks.size()) + chunks;
}

/// A figure with two joints and a mesh of one triangle; the figure bows within two seconds. The text is so small that
/// tests can damage every part.
inline constexpr std::string_view kSmallGltf = R"({"asset":{"version":"2.0"},
"scene":0,"scenes":[{"nodes":[0,2]}],
"nodes":[{"name":"Hips","children":[1],"translation":[0,1,0]},{"name":"Spine","translation":[0,0.5,0]},
{"name":"Body","mesh":0,"skin":0}],
"skins":[{"joints":[0,1],"inverseBindMatrices":4}],
"meshes":[{"name":"Coat","primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3,"material":0}]}],
"materials":[{"name":"Fur","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1]}}],
"animations":[{"name":"Bow","samplers":[{"input":5,"output":6}],"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},
{"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"},
{"bufferView":3,"componentType":5123,"count":3,"type":"SCALAR"},
{"bufferView":4,"componentType":5126,"count":2,"type":"MAT4"},
{"bufferView":5,"componentType":5126,"count":3,"type":"SCALAR"},
{"bufferView":6,"componentType":5126,"count":3,"type":"VEC4"}],
"bufferViews":[{"buffer":0,"byteLength":36},
{"buffer":0,"byteOffset":36,"byteLength":12},
{"buffer":0,"byteOffset":48,"byteLength":48},
{"buffer":0,"byteOffset":96,"byteLength":6},
{"buffer":0,"byteOffset":104,"byteLength":128},
{"buffer":0,"byteOffset":232,"byteLength":12},
{"buffer":0,"byteOffset":244,"byteLength":48}],
"buffers":[{"byteLength":292}]})";

/// The positions of the parts in the buffer.
enum SmallGltfPart : std::size_t {
  kPositions = 0,
  kJoints = 36,
  kWeights = 48,
  kIndices = 96,
  kBind = 104,
  kTimes = 232,
  kTurns = 244
};

inline std::string SmallBinary() {
  return Floats({0, 1, 0, 1, 1, 0, 0, 2, 0}) +                              // positions
         RawBytes<std::uint8_t>({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}) +     // joints
         Floats({1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0}) +               // weights
         RawBytes<std::uint16_t>({0, 1, 2, 0}) +                            // indices, padded
         Floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}) +        // inverse bind matrix: hips at height 1
         Floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1.5f, 0, 1}) +     // inverse bind: spine at height 1.5
         Floats({0, 1, 2}) +                                                // times, s
         Floats({0, 0, 0, 1, 0.70710678f, 0, 0, 0.70710678f, 0, 0, 0, 1});  // rotations: bent by 90° and back
}

inline std::string SmallGlb() { return Glb(std::string(kSmallGltf), SmallBinary()); }

inline GltfContent Read(const std::string& bytes, const FetchFile& fetch = {}) {
  auto content = ReadGltf(bytes, "test.glb", fetch);
  EXPECT_TRUE(content) << (content ? "" : ToString(content.error()));
  return content ? *content : GltfContent{};
}

inline std::string GlbComplaint(const std::string& bytes, const FetchFile& fetch = {}) {
  const auto content = ReadGltf(bytes, "test.glb", fetch);
  return content ? "read without complaint" : ToString(content.error());
}

/// Expects the properties that every accepted file must have.
inline void ExpectSane(const GltfContent& content) {
  const Character& character = content.character;
  const int joints = static_cast<int>(character.skeleton.joints.size());
  ASSERT_GT(joints, 0);
  for (int i = 0; i < joints; ++i) ASSERT_LT(character.skeleton.joints[i].parent, i);
  std::vector<GlobalTransform> globals;
  ComputeGlobals(character.skeleton, RestPose(character.skeleton), globals);
  for (const SkinnedMesh& mesh : character.meshes) {
    ASSERT_GE(mesh.material, 0);
    ASSERT_LT(mesh.material, static_cast<int>(character.materials.size()));
    for (const SkinnedMesh::Binding& binding : mesh.bindings) ASSERT_TRUE(binding.joint >= 0 && binding.joint < joints);
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
      ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-6);
      ASSERT_NEAR(vertex.weights[0] + vertex.weights[1] + vertex.weights[2] + vertex.weights[3], 1, 1e-6);
      for (const int binding : vertex.bindings) ASSERT_LT(binding, static_cast<int>(mesh.bindings.size()));
    }
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices.size());
    }
    const DeformedMesh deformed = Deform(mesh, globals);
    for (const glm::dvec3& position : deformed.positions) ASSERT_TRUE(IsFinite(position));
    for (const glm::dvec3& normal : deformed.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-6);
  }
  for (const Clip& clip : content.clips) {
    ASSERT_TRUE(std::isfinite(clip.rate_hz) && clip.rate_hz > 0);
    ASSERT_FALSE(clip.frames.empty());
    for (const LocalPose& pose : clip.frames) {
      for (const LocalTransform& local : pose) ASSERT_NEAR(glm::length(local.rotation), 1, 1e-6);
      ComputeGlobals(clip.skeleton, pose, globals);
      for (const GlobalTransform& global : globals) ASSERT_TRUE(IsFinite(global.position));
    }
  }
}

}  // namespace etude::testing
