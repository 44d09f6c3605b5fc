#include "sim/render/surface_batch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace etude {
namespace {

// Metres. Well inside what a float's products hold; NaN is not inside either.
constexpr float kFarthestCorner = 1e6f;

bool IsWithin(const glm::vec3& v, float limit) {
  return std::abs(v.x) < limit && std::abs(v.y) < limit && std::abs(v.z) < limit;
}

void AddCorners(const Surface& surface, const glm::dvec3& eye, std::vector<SurfaceCorner>& corners) {
  assert(surface.normals.size() == surface.positions.size() && surface.parts.size() == surface.triangles.size());
  const glm::vec3 paint = glm::vec3(surface.colour.r, surface.colour.g, surface.colour.b) / 255.0f;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const glm::vec4 paint_and_label(paint, static_cast<std::uint32_t>(surface.parts[i]));
    std::array<SurfaceCorner, 3> triangle{};
    std::ranges::transform(surface.triangles[i], triangle.begin(), [&](std::uint32_t vertex) {
      return SurfaceCorner{glm::vec3(surface.positions[vertex] - eye), glm::vec3(surface.normals[vertex]),
                           paint_and_label};
    });
    if (!std::ranges::all_of(triangle, [](const SurfaceCorner& corner) {
          return IsWithin(corner.place, kFarthestCorner) && IsWithin(corner.normal, 2);
        })) {
      continue;
    }
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
}

}  // namespace

std::vector<SurfaceCorner> MakeCorners(const std::vector<Figure>& figures, const glm::dvec3& eye) {
  std::vector<SurfaceCorner> corners;
  std::size_t triangles = 0;
  for (const Figure& figure : figures) {
    for (const Surface& surface : figure.surfaces) triangles += surface.triangles.size();
  }
  corners.reserve(3 * triangles);
  for (const Figure& figure : figures) {
    for (const Surface& surface : figure.surfaces) AddCorners(surface, eye, corners);
  }
  return corners;
}

}  // namespace etude
