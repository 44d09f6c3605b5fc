#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/formats/gltf/small_glb.h"
#include "tests/support/person.h"

namespace etude {
namespace {

using testing::Read;

void ExpectSame(const LocalTransform& found, const LocalTransform& expected, double tolerance) {
  EXPECT_LT(glm::length(found.translation - expected.translation), tolerance * (1 + glm::length(expected.translation)));
  EXPECT_LT(glm::length(found.rotation - expected.rotation), tolerance);
  EXPECT_LT(glm::length(found.scale - expected.scale), tolerance * glm::length(expected.scale));
}

void ExpectSame(const SkinnedMesh& found, const SkinnedMesh& expected, double tolerance) {
  EXPECT_EQ(found.name, expected.name);
  EXPECT_EQ(found.material, expected.material);
  EXPECT_EQ(found.triangles, expected.triangles);
  ASSERT_EQ(found.bindings.size(), expected.bindings.size());
  for (std::size_t i = 0; i < found.bindings.size(); ++i) {
    EXPECT_EQ(found.bindings[i].joint, expected.bindings[i].joint);
    for (int k = 0; k < 4; ++k) {
      EXPECT_LT(glm::length(found.bindings[i].inverse_bind[k] - expected.bindings[i].inverse_bind[k]), tolerance);
    }
  }
  ASSERT_EQ(found.vertices.size(), expected.vertices.size());
  for (std::size_t i = 0; i < found.vertices.size(); ++i) {
    EXPECT_LT(glm::length(found.vertices[i].position - expected.vertices[i].position), tolerance);
    EXPECT_LT(glm::length(found.vertices[i].normal - expected.vertices[i].normal), tolerance);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(found.vertices[i].weights[k], expected.vertices[i].weights[k], tolerance);
      if (expected.vertices[i].weights[k] != 0) {
        EXPECT_EQ(found.vertices[i].bindings[k], expected.vertices[i].bindings[k]);
      }
    }
  }
}

void ExpectSame(const GltfContent& found, const Character& character, const std::vector<Clip>& clips,
                double tolerance) {
  ASSERT_EQ(found.character.skeleton.joints.size(), character.skeleton.joints.size());
  for (std::size_t i = 0; i < character.skeleton.joints.size(); ++i) {
    const Joint& joint = found.character.skeleton.joints[i];
    EXPECT_EQ(joint.name, character.skeleton.joints[i].name);
    EXPECT_EQ(joint.parent, character.skeleton.joints[i].parent);
    ExpectSame(joint.rest, character.skeleton.joints[i].rest, 1e-15);  // not rounded to floats
  }
  ASSERT_EQ(found.character.materials.size(), character.materials.size());
  for (std::size_t i = 0; i < character.materials.size(); ++i) {
    EXPECT_EQ(found.character.materials[i].name, character.materials[i].name);
    EXPECT_EQ(found.character.materials[i].colour, character.materials[i].colour);
  }
  ASSERT_EQ(found.character.meshes.size(), character.meshes.size());
  for (std::size_t i = 0; i < character.meshes.size(); ++i) {
    SCOPED_TRACE("mesh " + character.meshes[i].name);
    ExpectSame(found.character.meshes[i], character.meshes[i], tolerance);
  }
  ASSERT_EQ(found.clips.size(), clips.size());
  for (std::size_t i = 0; i < clips.size(); ++i) {
    SCOPED_TRACE("clip " + clips[i].name);
    EXPECT_EQ(found.clips[i].name, clips[i].name);
    EXPECT_EQ(found.clips[i].rate_hz, clips[i].rate_hz);
    ASSERT_EQ(found.clips[i].frames.size(), clips[i].frames.size());
    for (std::size_t k = 0; k < clips[i].frames.size(); ++k) {
      for (std::size_t j = 0; j < character.skeleton.joints.size(); ++j) {
        ExpectSame(found.clips[i].frames[k][j], clips[i].frames[k][j], tolerance);
      }
    }
  }
}

constexpr double kFloat = 2e-7;  // a float's relative precision with a few roundings

SkinnedMesh::Vertex VertexAt(double x, double y, double z) {
  SkinnedMesh::Vertex vertex;
  vertex.position = {x, y, z};
  vertex.normal = glm::normalize(glm::dvec3(x + 0.1, y - 0.3, z));
  return vertex;
}

/// Returns a person with a skinned coat of two colours, and a rigid hat and feather on one joint, under a scaled root.
Character Dressed() {
  Character person{.name = "person", .skeleton = testing::PersonSkeleton(), .materials = {}, .meshes = {}};
  person.skeleton.joints[0].rest.scale = {0.01, 0.01, 0.01};
  person.skeleton.joints[0].rest.rotation = glm::angleAxis(0.3, glm::normalize(glm::dvec3(1, 2, 3)));
  person.materials = {{"wool", {0.1, 0.2, 0.3}}, {"felt", {0.7, 0.0, 1.0}}};

  SkinnedMesh coat;
  coat.name = "coat";
  for (int joint = 0; joint < 3; ++joint) {
    SkinnedMesh::Binding binding;
    binding.joint = joint;
    binding.inverse_bind[0] = {100, 0, 0, 0};
    binding.inverse_bind[3] = {0, -1.1 * joint, 0.7, 1};
    coat.bindings.push_back(binding);
  }
  for (int i = 0; i < 5; ++i) {
    SkinnedMesh::Vertex vertex = VertexAt(0.1 * i, 1.0 / (3 + i), -0.7);
    vertex.bindings = {i % 3, (i + 1) % 3, 0, 0};
    vertex.weights = {0.7, 0.3, 0, 0};
    coat.vertices.push_back(vertex);
  }
  coat.triangles = {{0, 1, 2}, {2, 3, 4}};
  SkinnedMesh hem = coat;
  hem.material = 1;
  hem.triangles = {{4, 3, 0}};

  SkinnedMesh hat;
  hat.name = "hat";
  hat.material = 1;
  hat.bindings.resize(1);
  hat.bindings[0].joint = person.skeleton.Find("Head");
  for (int i = 0; i < 3; ++i) hat.vertices.push_back(VertexAt(i, 0.5, i * i));
  hat.triangles = {{0, 2, 1}};
  SkinnedMesh feather = hat;
  feather.name = "feather";
  person.meshes = {coat, hem, hat, feather};
  return person;
}

Clip Dance(const Character& character, const std::string& name, double rate_hz, int frames) {
  Clip clip = testing::AtRest(character.skeleton, frames, rate_hz);
  clip.name = name;
  for (int k = 0; k < frames; ++k) {
    const double t = k / rate_hz;
    testing::At(clip, k, "Hips").translation += glm::dvec3(std::sin(t), 0.1 * t, 0);
    testing::At(clip, k, "LeftArm").rotation = glm::angleAxis(2 * std::sin(3 * t), glm::normalize(glm::dvec3(1, t, 2)));
    testing::At(clip, k, "Head").scale = {1 + 0.1 * t, 1, 1};
    testing::At(clip, k, "RightArm").rotation = glm::angleAxis(1.5, glm::dvec3(0, 0, 1));  // constant, but not at rest
  }
  return clip;
}

TEST(GltfRoundTrip, KeepsAFigureAndItsClipsToAFloatsPrecision) {
  const Character person = Dressed();
  const std::vector<Clip> clips = {Dance(person, "slow", 24, 30), Dance(person, "fast", 120, 77),
                                   Dance(person, "odd", 29.97, 5)};
  ExpectSame(Read(WriteGlb(person, clips)), person, clips, kFloat);
}

TEST(GltfRoundTrip, OfWhatWasReadGivesTheSameBytes) {
  const Character person = Dressed();
  const std::vector<Clip> clips = {Dance(person, "slow", 24, 30), Dance(person, "fast", 120, 77)};
  const std::string bytes = WriteGlb(person, clips);
  EXPECT_EQ(WriteGlb(person, clips), bytes);
  const GltfContent again = Read(bytes);
  EXPECT_EQ(WriteGlb(again.character, again.clips), bytes);
}

TEST(GltfRoundTrip, KeepsASkeletonAlone) {
  const Character bones{.name = "bones", .skeleton = testing::PersonSkeleton(), .materials = {}, .meshes = {}};
  ExpectSame(Read(WriteGlb(bones, {})), bones, {}, kFloat);
}

TEST(GltfRoundTrip, BindsMeshesOfOneBindingByOneSkin) {
  const auto skins = [](const Character& character) {
    const std::string bytes = WriteGlb(character, {});
    int count = 0;
    for (std::size_t at = 0; (at = bytes.find("inverseBindMatrices", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  Character person = Dressed();
  SkinnedMesh cape = person.meshes[0], scarf = cape;
  cape.name = "cape";
  scarf.name = "scarf";
  person.meshes = {person.meshes[0], cape};
  EXPECT_EQ(skins(person), 1);
  ExpectSame(Read(WriteGlb(person, {})), person, {}, kFloat);
  scarf.bindings[1].inverse_bind[3].y += 0.5;
  person.meshes = {person.meshes[0], scarf, cape};
  EXPECT_EQ(skins(person), 2) << "the control";
  ExpectSame(Read(WriteGlb(person, {})), person, {}, kFloat);
}

TEST(GltfRoundTrip, WritesMaterialsThatAreNoMetal) {
  const Character person = Dressed();
  const std::string bytes = WriteGlb(person, {});
  std::size_t count = 0;
  for (std::size_t at = 0; (at = bytes.find(R"("metallicFactor":0.0)", at)) != std::string::npos; ++at) ++count;
  EXPECT_EQ(count, person.materials.size()) << "the format's default is bare metal";
}

TEST(GltfRoundTrip, KeepsAClipInWhichNothingMoves) {
  const Character person = Dressed();
  Clip still = testing::AtRest(person.skeleton, 41, 20);
  still.name = "still";
  ExpectSame(Read(WriteGlb(person, {&still, 1})), person, {still}, kFloat);
}

TEST(GltfRoundTrip, KeepsWhichSideOfAMirroredSurfaceIsTheOutside) {
  Character person = Dressed();
  person.skeleton.joints[person.skeleton.Find("Neck")].rest.scale = {-1, 1, 1};
  ExpectSame(Read(WriteGlb(person, {})), person, {}, kFloat);
}

TEST(GltfRoundTrip, KeepsMeshesOfManyVerticesAndBones) {
  Character chain{.name = "chain", .skeleton = {}, .materials = {{"red", {1, 0, 0}}}, .meshes = {}};
  SkinnedMesh mesh{.name = "scales"};
  constexpr int kBones = 300;  // more than a byte can count
  for (int i = 0; i < kBones; ++i) {
    chain.skeleton.joints.push_back({.name = "bone " + std::to_string(i), .parent = i == 0 ? -1 : 0, .rest = {}});
    SkinnedMesh::Binding binding;
    binding.joint = i;
    mesh.bindings.push_back(binding);
  }
  constexpr std::uint32_t kVertices = 70'000;  // more than a short can count
  for (std::uint32_t i = 0; i < kVertices; ++i) {
    mesh.vertices.push_back(VertexAt(i * 1e-4, 0.5, 0.25));
    mesh.vertices.back().bindings[0] = static_cast<int>(i) % kBones;
  }
  mesh.triangles = {{0, 1, kVertices - 1}};
  chain.meshes.push_back(mesh);
  ExpectSame(Read(WriteGlb(chain, {})), chain, {}, 1e-6);
}

TEST(GltfRoundTrip, MakesNamesUtf8) {
  Character bones{.name = "bones", .skeleton = {}, .materials = {}, .meshes = {}};
  for (const char* name : {"H\xC3\xBC"
                           "fte",
                           "\xFF\xC3", "\xE0\x80\x80", "\xF0\x9F\x90\xBB", "\xED\xA0\x80"}) {
    bones.skeleton.joints.push_back({.name = name, .parent = -1, .rest = {}});
  }
  const Skeleton skeleton = Read(WriteGlb(bones, {})).character.skeleton;
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  EXPECT_THAT(names, ::testing::ElementsAre("H\xC3\xBC"
                                            "fte",
                                            "??", "???", "\xF0\x9F\x90\xBB", "???#2"));
}

}  // namespace
}  // namespace etude
