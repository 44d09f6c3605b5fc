#include "engine/motion/character.h"

namespace etude {
namespace {

/// An affine map p ↦ shift + axes · p.
struct Move {
  glm::dmat3 axes{0};
  glm::dvec3 shift{0};
};

/// Returns the cofactor matrix of `axes`: the inverse transpose times the determinant. It also exists if `axes` is
/// singular (a joint with a scale of 0).
glm::dmat3 NormalAxes(const glm::dmat3& axes) {
  const glm::dmat3 cofactors(glm::cross(axes[1], axes[2]), glm::cross(axes[2], axes[0]), glm::cross(axes[0], axes[1]));
  const bool is_mirrored = glm::dot(axes[0], cofactors[0]) < 0;
  return is_mirrored ? -cofactors : cofactors;
}

glm::dvec3 TransformedNormal(const glm::dmat3& normal_axes, const glm::dvec3& normal) {
  const glm::dvec3 turned = normal_axes * normal;
  const double length = glm::length(turned);
  return length > 0 ? turned / length : normal;
}

}  // namespace

DeformedMesh Deform(const SkinnedMesh& mesh, const std::vector<GlobalTransform>& globals) {
  // Compute the affine map of every binding.
  std::vector<Move> moves;
  std::vector<glm::dmat3> normal_moves;
  for (const SkinnedMesh::Binding& binding : mesh.bindings) {
    const GlobalTransform& global = globals[binding.joint];
    const glm::dmat3 inverse_axes(binding.inverse_bind);
    moves.push_back({global.axes * inverse_axes, global.position + global.axes * glm::dvec3(binding.inverse_bind[3])});
    normal_moves.push_back(NormalAxes(moves.back().axes));
  }
  DeformedMesh deformed;
  deformed.positions.reserve(mesh.vertices.size());
  deformed.normals.reserve(mesh.vertices.size());
  for (const SkinnedMesh::Vertex& vertex : mesh.vertices) {
    if (vertex.weights[0] == 1) {  // the usual case: one binding has the whole weight
      const Move& move = moves[vertex.bindings[0]];
      deformed.positions.push_back(move.shift + move.axes * vertex.position);
      deformed.normals.push_back(TransformedNormal(normal_moves[vertex.bindings[0]], vertex.normal));
      continue;
    }
    // Blend the maps of up to four bindings.
    Move blend;
    for (std::size_t i = 0; i < vertex.weights.size(); ++i) {
      if (vertex.weights[i] == 0) continue;
      const Move& move = moves[vertex.bindings[i]];
      blend.axes += vertex.weights[i] * move.axes;
      blend.shift += vertex.weights[i] * move.shift;
    }
    deformed.positions.push_back(blend.shift + blend.axes * vertex.position);
    deformed.normals.push_back(TransformedNormal(NormalAxes(blend.axes), vertex.normal));
  }
  return deformed;
}

}  // namespace etude
