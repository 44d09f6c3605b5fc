#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "sim/render/scene.h"

namespace etude {

/// One capsule as the vertex shader reads it (kCapsuleBox in shaders.h); frame E has the world's axes and the origin at
/// the camera's centre.
struct CapsuleInstance {
  glm::vec4 start_and_radius;  ///< in E; of a face, the chin's end
  glm::vec4 end_and_label;     ///< in E
  glm::vec4 paint;             ///< RGB 0…1; A = 1 for a head that gets a face
  glm::vec3 front;             ///< unit; where the face looks
};

/// Returns all capsules of all figures. Capsules that are not finite, or not thicker than nothing, are left out.
std::vector<CapsuleInstance> MakeInstances(const std::vector<Figure>& figures, const glm::dvec3& eye);

/// One corner of a triangle as the surface shaders read it; frame E has the world's axes and the origin at the
/// camera's centre.
struct SurfaceCorner {
  glm::vec3 place;  ///< in E
  glm::vec3 normal;
  glm::vec4 paint_and_label;  ///< RGB 0…1; A = the triangle's label
  glm::vec4
      rest_and_paint;  ///< the place on the body at rest, or RG = that on the texture; A = the paint's number, or −1
};

/// Triangles, three indices each. Those that share a vertex and are of one part share its corner: GL shades it once.
struct Triangles {
  std::vector<SurfaceCorner> corners;
  std::vector<std::uint32_t> indices;
};

/// A run of indices that have one texture.
struct TexturedRun {
  SharedTexture texture;
  std::size_t first = 0, count = 0;
};

/// All triangles.
struct SurfaceTriangles {
  Triangles plain;    ///< of surfaces in one colour
  Triangles painted;  ///< of those with a paint
  Triangles textured;
  std::vector<TexturedRun> textures;  ///< whose `textured` are
};

/// Collects all triangles of all figures into `all`. Triangles with a corner or normal that is not finite, or that
/// lies beyond any scene, are left out. Paints are numbered in the order of PaintsOf. The memory of `all` is used
/// again.
void MakeTriangles(const std::vector<Figure>& figures, const glm::dvec3& eye, SurfaceTriangles& all);

/// Returns the paints of all surfaces, in the order of their numbers.
std::vector<SurfacePaint> PaintsOf(const std::vector<Figure>& figures);

}  // namespace etude
