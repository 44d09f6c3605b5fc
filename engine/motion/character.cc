#include "engine/motion/character.h"

namespace etude {
namespace {

glm::dmat4 ToMatrix(const GlobalTransform& global) {
  glm::dmat4 matrix(global.axes);
  matrix[3] = glm::dvec4(global.position, 1);
  return matrix;
}

}  // namespace

DeformedMesh Deform(const SkinnedMesh& mesh, const std::vector<GlobalTransform>& globals) {
  std::vector<glm::dmat4> moves;
  moves.reserve(mesh.bindings.size());
  for (const SkinnedMesh::Binding& binding : mesh.bindings) {
    moves.push_back(ToMatrix(globals[binding.joint]) * binding.inverse_bind);
  }
  DeformedMesh deformed;
  deformed.positions.reserve(mesh.vertices.size());
  deformed.normals.reserve(mesh.vertices.size());
  for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
    glm::dmat4 move(0);
    for (std::size_t i = 0; i < vertex.weights.size(); ++i) {
      if (vertex.weights[i] != 0) move += vertex.weights[i] * moves[vertex.bindings[i]];
    }
    deformed.positions.push_back(glm::dvec3(move * glm::dvec4(vertex.position, 1)));
    // The cofactors are the inverse transpose but for a factor, and exist for flattened joints too.
    const glm::dmat3 turn(move);
    const glm::dmat3 cofactors(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]),
                               glm::cross(turn[0], turn[1]));
    const glm::dvec3 normal = cofactors * vertex.normal;
    const double length = glm::length(normal);
    deformed.normals.push_back(length > 0 ? normal / length : vertex.normal);
  }
  return deformed;
}

}  // namespace etude
