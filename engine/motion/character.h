#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/motion/clip.h"

namespace etude {

/// The material of a surface.
struct Material {
  std::string name;
  glm::dvec3 colour{0.8};   ///< linear RGB, 0…1 (glTF's base colour factor)
  SharedTexture texture{};  ///< if set, replaces `colour`; the texels are already multiplied by `colour`
};

/// A surface that follows a skeleton by linear blend skinning (glTF's skin). A rigid mesh has one binding.
struct SkinnedMesh {
  /// A joint that vertices may follow.
  struct Binding {
    int joint = 0;               ///< index of a joint in the character's skeleton
    glm::dmat4 inverse_bind{1};  ///< transform from the mesh's frame to the joint's, in the bind pose
  };
  struct Vertex {
    glm::dvec3 position{0};
    glm::dvec3 normal{0};                       ///< unit vector
    std::array<int, 4> bindings{};              ///< indices of bindings in SkinnedMesh::bindings
    std::array<double, 4> weights{1, 0, 0, 0};  ///< weights of these bindings; they sum to 1
    glm::dvec2 on_texture{0};                   ///< texture coordinates
  };

  std::string name;
  int material = 0;  ///< index of the mesh's material in Character::materials
  std::vector<Binding> bindings;
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// A figure that can be drawn: meshes bound to a skeleton, in the unit and axes of the character's file.
struct Character {
  std::string name;
  Skeleton skeleton;
  std::vector<Material> materials;
  std::vector<SkinnedMesh> meshes;
};

/// A mesh's vertices in the world, in one pose of its skeleton.
struct DeformedMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  ///< unit vectors
};

/// Deforms a mesh by linear blend skinning: v ↦ Σ wᵢ · globalᵢ · inverse_bindᵢ · v. `globals` is the output of
/// ComputeGlobals for the skeleton that the mesh is bound to. Normals are transformed by the inverse transpose.
DeformedMesh Deform(const SkinnedMesh& mesh, const std::vector<GlobalTransform>& globals);

}  // namespace etude
