#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "sim/render/scene.h"

namespace etude {

/// One capsule as input of the vertex shader (kCapsuleBox in shaders.h). Frame E has the world's axes and its origin at
/// the camera's centre.
struct CapsuleInstance {
  glm::vec4 start_and_radius;  ///< start of the axis in E, and radius; for a face, the start is at the chin
  glm::vec4 end_and_label;     ///< end of the axis in E, and the capsule's label
  glm::vec4 paint;             ///< RGB 0…1; A = 1 for a head that gets a face
  glm::vec3 front;             ///< unit direction in which the face looks
};

/// Returns all capsules of all figures, except those with infinite or NaN coordinates or without a positive radius.
std::vector<CapsuleInstance> MakeInstances(const std::vector<Figure>& figures, const glm::dvec3& eye);

/// One corner of a triangle as input of the surface shaders. Frame E has the world's axes and its origin at the
/// camera's centre.
struct SurfaceCorner {
  glm::vec3 place;  ///< position in E
  glm::vec3 normal;
  glm::vec4 paint_and_label;  ///< RGB 0…1; A = the triangle's label
  glm::vec4
      rest_and_paint;  ///< position on the body at rest, or RG = position on the texture; A = the paint's index or −1
};

/// Triangles. Each triangle is three indices of corners. If triangles of one part share a vertex, they share its
/// corner, and GL shades this corner only once.
struct Triangles {
  std::vector<SurfaceCorner> corners;
  std::vector<std::uint32_t> indices;
};

/// A run of consecutive indices with the same texture.
struct TexturedRun {
  SharedTexture texture;
  std::size_t first = 0, count = 0;
};

/// The triangles of all surfaces, grouped by the kind of paint.
struct SurfaceTriangles {
  Triangles plain;    ///< surfaces in one colour
  Triangles painted;  ///< surfaces with a paint
  Triangles textured;
  std::vector<TexturedRun> textures;  ///< for each run of indices of `textured`, the texture
};

/// Writes the triangles of all figures to `all`, whose memory is reused. Triangles are left out if a corner or a normal
/// is not finite, or if a corner is far outside any scene. Paints have indices in the order of PaintsOf.
void MakeTriangles(const std::vector<Figure>& figures, const glm::dvec3& eye, SurfaceTriangles& all);

/// Returns the paints of all surfaces in the order of their indices.
std::vector<SurfacePaint> PaintsOf(const std::vector<Figure>& figures);

}  // namespace etude
