#include "engine/silhouettes/silhouette.h"

#include <algorithm>
#include <cmath>

#include "engine/silhouettes/distance_transform.h"

namespace etude {
namespace {

// Whether one of the four neighbours within the picture is unset: what the picture's edge cuts off is no outline.
bool IsOutline(const Mask& mask, int x, int y) {
  const auto unset = [&](int i, int j) { return mask.Contains(i, j) && mask.At(i, j) == 0; };
  return unset(x - 1, y) || unset(x + 1, y) || unset(x, y - 1) || unset(x, y + 1);
}

// Out of the mask: away from the middle of the set pixels in a window about the pixel.
glm::dvec2 NormalAt(const Mask& mask, int x, int y) {
  constexpr int kReach = 3;
  glm::dvec2 inwards(0);
  for (int j = -kReach; j <= kReach; ++j) {
    for (int i = -kReach; i <= kReach; ++i) {
      if (mask.Contains(x + i, y + j) && mask.At(x + i, y + j) != 0) inwards += glm::dvec2(i, j);
    }
  }
  const double length = glm::length(inwards);
  return length > 0 ? -inwards / length : glm::dvec2(0);
}

}  // namespace

Silhouette MakeSilhouette(const Mask& mask, const SilhouetteOptions& options) {
  Silhouette made;
  made.distances = SignedDistances(mask);
  made.mask_pixel = options.mask_pixel;
  const int cells = mask.width / options.spacing + 1;
  std::vector<char> taken(static_cast<std::size_t>(cells) * (mask.height / options.spacing + 1), 0);
  glm::dvec2 sum(0);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.At(x, y) == 0) continue;
      sum += glm::dvec2(x + 0.5, y + 0.5);
      ++made.area;
      char& cell = taken[static_cast<std::size_t>(y / options.spacing) * cells + x / options.spacing];
      if (cell || !IsOutline(mask, x, y)) continue;
      cell = 1;
      const glm::dvec2 normal = NormalAt(mask, x, y);
      made.outline.push_back({options.mask_pixel * (glm::dvec2(x + 0.5, y + 0.5) + 0.5 * normal), normal});
    }
  }
  if (made.area > 0) made.centre = options.mask_pixel * sum / static_cast<double>(made.area);
  return made;
}

DistanceAt DistanceAtPixel(const Silhouette& silhouette, const glm::dvec2& pixel) {
  const Image<float>& field = silhouette.distances;
  const glm::dvec2 at = pixel / silhouette.mask_pixel - 0.5;
  const double u = std::clamp(at.x, 0.0, field.width - 1.0), v = std::clamp(at.y, 0.0, field.height - 1.0);
  const int x = std::min(static_cast<int>(u), field.width - 2), y = std::min(static_cast<int>(v), field.height - 2);
  const double s = u - x, t = v - y;
  const double a = field.At(x, y), b = field.At(x + 1, y), c = field.At(x, y + 1), d = field.At(x + 1, y + 1);
  DistanceAt found;
  found.distance = silhouette.mask_pixel * ((1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d));
  found.gradient = {(1 - t) * (b - a) + t * (d - c), (1 - s) * (c - a) + s * (d - b)};
  if (u != at.x) found.gradient.x = 0;
  if (v != at.y) found.gradient.y = 0;
  return found;
}

}  // namespace etude
