#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace etude {

/// Calls `put` for every pixel whose centre lies within `radius` of the segment; with flat ends, for none before a or
/// behind b. `put` gets the pixel and its position along the segment, 0 to 1 (less before a, more behind b).
template <typename Put>
void DrawPen(int width, int height, const glm::dvec2& a, const glm::dvec2& b, double radius, bool has_flat_ends,
             Put put) {
  const glm::dvec2 along = b - a, low = glm::min(a, b) - radius - 1.0, high = glm::max(a, b) + radius + 1.0;
  for (int y = std::max(0, static_cast<int>(low.y)); y < std::min<double>(height, high.y); ++y) {
    for (int x = std::max(0, static_cast<int>(low.x)); x < std::min<double>(width, high.x); ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      const double share = glm::dot(p - a, along) / glm::dot(along, along);
      if (has_flat_ends && (share < 0 || share > 1)) continue;
      if (glm::distance(p, a + std::clamp(share, 0.0, 1.0) * along) < radius) put(x, y, share);
    }
  }
}

}  // namespace etude
