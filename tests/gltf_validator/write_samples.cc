// Writes GLBs for the validator: write_samples FOLDER fills FOLDER/good and FOLDER/broken.
#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "engine/formats/gltf/gltf.h"
#include "engine/retargeting/rig.h"
#include "sim/character/characters.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/support/person.h"

namespace etude {
namespace {

SkinnedMesh Triangle(const std::string& name, int joint) {
  SkinnedMesh mesh{.name = name};
  mesh.bindings.resize(1);
  mesh.bindings[0].joint = joint;
  for (int i = 0; i < 3; ++i) {
    SkinnedMesh::Vertex vertex;
    vertex.position = {0.1 * i, 0.3 * (i % 2), 0.7};
    vertex.normal = {0, 0, 1};
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles = {{0, 2, 1}};
  return mesh;
}

/// Returns everything that the writer supports: surfaces with and without a skin, two on one joint, several parts of a
/// surface, scaled and mirrored joints.
Character Patchwork() {
  Character person{.name = "patchwork", .skeleton = testing::PersonSkeleton(), .materials = {}, .meshes = {}};
  person.skeleton.joints[0].rest.scale = {0.01, 0.01, 0.01};
  person.skeleton.joints[0].rest.rotation = glm::angleAxis(0.3, glm::normalize(glm::dvec3(1, 2, 3)));
  person.skeleton.joints[3].rest.scale = {-1, 1, 1};
  person.materials = {{"wool", {0.1, 0.2, 0.3}}, {"felt", {1, 1, 1}}, {"", {0, 0, 0}}};
  SkinnedMesh coat = Triangle("coat", 1);
  coat.bindings.push_back({2, glm::dmat4(100)});
  coat.bindings[1].inverse_bind[3] = {0, -1, 0, 1};
  for (SkinnedMesh::Vertex& vertex : coat.vertices) {
    vertex.bindings = {0, 1, 0, 0};
    vertex.weights = {1.0 / 3, 2.0 / 3, 0, 0};
  }
  SkinnedMesh hem = coat;
  hem.material = 2;
  person.meshes = {coat, hem, Triangle("hat", 3), Triangle("feather", 3), Triangle("shoe", 6)};
  return person;
}

/// Returns a clip that rotates, moves and scales; no float represents its `rate_hz` exactly.
Clip Wriggle(const Skeleton& skeleton, const std::string& name, int frames, double rate_hz) {
  Clip clip = testing::AtRest(skeleton, frames, rate_hz);
  clip.name = name;
  for (int k = 0; k < frames; ++k) {
    const double t = k / rate_hz;
    testing::At(clip, k, "Hips").translation += glm::dvec3(std::sin(t), 0, 0);
    testing::At(clip, k, "LeftArm").rotation = glm::angleAxis(2 * std::sin(3 * t), glm::normalize(glm::dvec3(1, t, 2)));
    testing::At(clip, k, "RightArm").rotation = glm::angleAxis(1.5, glm::dvec3(0, 0, 1));
    testing::At(clip, k, "Head").scale = {1 + 0.1 * t, 1, 1};
  }
  return clip;
}

void Save(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Returns a generated character that dances every built-in move.
std::string Dancing(const Character& character) {
  std::vector<Clip> clips;
  for (const std::string& name : BuiltinMoveNames()) {
    if (const auto move = LoadBuiltinMove(name)) clips.push_back(RigClip(move->motion, StandingPose(), name));
  }
  return WriteGlb(character, clips);
}

void WriteSamples(const std::filesystem::path& folder) {
  const Character patchwork = Patchwork();
  const std::vector<Clip> clips = {Wriggle(patchwork.skeleton, "wriggle", 200, 30),
                                   Wriggle(patchwork.skeleton, "odd \"rate\" \xFF", 50, 29.97),
                                   testing::AtRest(patchwork.skeleton, 3), testing::AtRest(patchwork.skeleton, 1)};
  const std::string good = WriteGlb(patchwork, clips);
  Save(folder / "good/patchwork.glb", good);
  const Character bones{.name = "bones", .skeleton = testing::PersonSkeleton(), .materials = {}, .meshes = {}};
  Save(folder / "good/bones.glb", WriteGlb(bones, {}));
  Save(folder / "good/moving_bones.glb", WriteGlb(bones, {clips.data(), 1}));
  Save(folder / "good/bear.glb", Dancing(BearCharacter()));
  Save(folder / "good/mannequin.glb", Dancing(MannequinCharacter()));

  // A joint that is its own child, and positions at a wrong place.
  std::string cycle = good;
  const std::string children = "\"children\":[1,";
  cycle.replace(cycle.find(children), children.size(), "\"children\":[0,");
  Save(folder / "broken/cycle.glb", cycle);
  std::string bytes = good;
  bytes[bytes.find("BIN") + 4] ^= 0x40;
  Save(folder / "broken/moved_position.glb", bytes);
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: {} FOLDER\n", argv[0]);
    return 2;
  }
  etude::WriteSamples(argv[1]);
  return 0;
}
