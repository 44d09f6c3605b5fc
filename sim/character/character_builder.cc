#include "sim/character/character_builder.h"

#include <utility>

#include "engine/base/image.h"
#include "engine/motion/from_body.h"

namespace etude {
namespace {

/// Per vertex, the mean of its triangles' normals, weighted by their areas.
std::vector<glm::dvec3> Normals(const Piece& piece) {
  std::vector<glm::dvec3> normals(piece.vertices.size(), glm::dvec3(0));
  for (const auto& [a, b, c] : piece.triangles) {
    const glm::dvec3 at = piece.vertices[a].position;
    const glm::dvec3 normal = glm::cross(piece.vertices[b].position - at, piece.vertices[c].position - at);
    for (const std::uint32_t corner : {a, b, c}) normals[corner] += normal;
  }
  for (glm::dvec3& normal : normals) normal = glm::normalize(normal);
  return normals;
}

}  // namespace

CharacterBuilder::CharacterBuilder(std::string name, const BodyPose& rest) : rest_(rest) {
  character_.name = std::move(name);
  character_.skeleton = BodySkeleton(rest);
}

int CharacterBuilder::AddMaterial(std::string name, Rgb8 colour) {
  const int material = static_cast<int>(character_.materials.size());
  SkinnedMesh mesh{.name = name, .material = material, .bindings = {}, .vertices = {}, .triangles = {}};
  // Bindings are numbered as roles are; at rest all axes are the world's.
  for (const Role role : AllRoles()) {
    glm::dmat4 inverse_bind(1);
    inverse_bind[3] = glm::dvec4(-rest_[role], 1);
    mesh.bindings.push_back({static_cast<int>(Index(role)), inverse_bind});
  }
  character_.meshes.push_back(std::move(mesh));
  character_.materials.push_back(
      {std::move(name), {LinearOfSrgb(colour.r), LinearOfSrgb(colour.g), LinearOfSrgb(colour.b)}});
  return material;
}

void CharacterBuilder::Add(int material, const Piece& piece) {
  SkinnedMesh& mesh = character_.meshes[material];
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::vector<glm::dvec3> normals = Normals(piece);
  for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
    const Piece::Vertex& vertex = piece.vertices[i];
    SkinnedMesh::Vertex& bound = mesh.vertices.emplace_back();
    bound.position = vertex.position;
    bound.normal = normals[i];
    for (std::size_t k = 0; k < vertex.joints.size(); ++k) {
      bound.bindings[k] = static_cast<int>(Index(vertex.joints[k]));
      bound.weights[k] = vertex.weights[k];
    }
  }
  for (const auto& [a, b, c] : piece.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

void CharacterBuilder::AddOnBothSides(int material, const Piece& piece) {
  Add(material, piece);
  Add(material, MirrorImage(piece));
}

}  // namespace etude
