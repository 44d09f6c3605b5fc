#include "engine/silhouettes/silhouette.h"

#include <algorithm>
#include <cassert>

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

struct Box {
  int left, top, right, bottom;  // the last two just outside
};

// About all set pixels, with a margin as far as the picture goes; empty when there are none.
Box BoxOf(const Mask& mask) {
  constexpr int kMargin = 8;
  Box box{mask.width, mask.height, 0, 0};
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.At(x, y) == 0) continue;
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1), y + 1};
    }
  }
  return {std::max(box.left - kMargin, 0), std::max(box.top - kMargin, 0), std::min(box.right + kMargin, mask.width),
          std::min(box.bottom + kMargin, mask.height)};
}

Mask CutOut(const Mask& mask, const Box& box) {
  Mask part(box.right - box.left, box.bottom - box.top);
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) part.At(x, y) = mask.At(box.left + x, box.top + y);
  }
  return part;
}

// The pixels whose signed distance is at most `distance`: grown by it, or shrunk where it is negative.
Mask Grown(const Mask& mask, double distance) {
  const Image<float> distances = SignedDistances(mask);
  Mask grown(mask.width, mask.height);
  for (std::size_t i = 0; i < grown.pixels.size(); ++i) grown.pixels[i] = distances.pixels[i] <= distance;
  return grown;
}

// Without what is thinner than the disc.
Mask Opened(const Mask& mask, double radius) {
  if (radius <= 0) return mask;
  return Grown(Grown(mask, -radius), radius);
}

void SampleOutline(const Mask& mask, const SilhouetteOptions& options, Silhouette& made) {
  const int cells = mask.width / options.spacing + 1;
  std::vector<char> taken(static_cast<std::size_t>(cells) * (mask.height / options.spacing + 1), 0);
  glm::dvec2 sum(0);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.At(x, y) == 0) continue;
      const glm::dvec2 pixel(made.left + x + 0.5, made.top + y + 0.5);
      sum += pixel;
      ++made.area;
      char& cell = taken[static_cast<std::size_t>(y / options.spacing) * cells + x / options.spacing];
      if (cell || !IsOutline(mask, x, y)) continue;
      cell = 1;
      const glm::dvec2 normal = NormalAt(mask, x, y);
      made.outline.push_back({options.mask_pixel * (pixel + 0.5 * normal), normal});
    }
  }
  if (made.area > 0) made.centre = options.mask_pixel * sum / static_cast<double>(made.area);
}

}  // namespace

Silhouette MakeSilhouette(const Mask& mask, const SilhouetteOptions& options) {
  Silhouette made;
  made.width = mask.width;
  made.height = mask.height;
  made.mask_pixel = options.mask_pixel;
  const Box box = BoxOf(mask);
  if (box.right <= box.left + 1 || box.bottom <= box.top + 1) return made;
  made.left = box.left;
  made.top = box.top;
  const Mask person = Opened(CutOut(mask, box), options.thinnest);
  made.distances = SignedDistances(person);
  SampleOutline(person, options, made);
  return made;
}

DistanceAt DistanceAtPixel(const Silhouette& silhouette, const glm::dvec2& pixel) {
  assert(silhouette.area > 0);
  const Image<float>& field = silhouette.distances;
  const glm::dvec2 wanted = pixel / silhouette.mask_pixel - 0.5;
  const glm::dvec2 seen = glm::clamp(wanted, glm::dvec2(0), glm::dvec2(silhouette.width - 1, silhouette.height - 1));
  const glm::dvec2 in_box = seen - glm::dvec2(silhouette.left, silhouette.top);
  const glm::dvec2 at = glm::clamp(in_box, glm::dvec2(0), glm::dvec2(field.width - 1, field.height - 1));
  const int x = std::min(static_cast<int>(at.x), field.width - 2),
            y = std::min(static_cast<int>(at.y), field.height - 2);
  const double s = at.x - x, t = at.y - y;
  const double a = field.At(x, y), b = field.At(x + 1, y), c = field.At(x, y + 1), d = field.At(x + 1, y + 1);
  DistanceAt found{(1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d),
                   {(1 - t) * (b - a) + t * (d - c), (1 - s) * (c - a) + s * (d - b)}};
  const glm::dvec2 beyond = in_box - at;
  for (int axis = 0; axis < 2; ++axis) {
    if (beyond[axis] != 0 || seen[axis] != wanted[axis]) found.gradient[axis] = 0;
  }
  const double away = glm::length(beyond);
  if (away > 0) {
    found.distance += away;
    for (int axis = 0; axis < 2; ++axis) {
      if (seen[axis] == wanted[axis]) found.gradient[axis] += beyond[axis] / away;
    }
  }
  found.distance *= silhouette.mask_pixel;
  return found;
}

}  // namespace etude
