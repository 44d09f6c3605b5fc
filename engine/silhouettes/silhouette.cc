#include "engine/silhouettes/silhouette.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/silhouettes/nearest_cones.h"

namespace etude {
namespace {

// The lower envelope of up to `size` parabolas (x − q)² + heights[q] (DT1D in the paper of Felzenszwalb and
// Huttenlocher).
class Envelope {
 public:
  explicit Envelope(int size) : apex_(size), begins_(size + 1) {}

  // Computes out[x] = min over q of (x − q)² + heights[q]; heights of at least `kNone` count as infinite.
  void Fill(const std::vector<double>& heights, int size, std::vector<double>& out) {
    // Add the parabolas from left to right. Each new parabola removes earlier parabolas that are no longer lowest
    // anywhere.
    int last = -1;
    for (int q = 0; q < size; ++q) {
      if (heights[q] >= kNone) continue;
      double begin = -kNone;
      while (last >= 0) {
        const int p = apex_[last];
        begin = ((heights[q] + q * q) - (heights[p] + p * p)) / (2.0 * (q - p));
        if (begin > begins_[last]) break;
        --last;
      }
      if (last < 0) begin = -kNone;
      ++last;
      apex_[last] = q;
      begins_[last] = begin;
      begins_[last + 1] = kNone;
    }
    if (last < 0) {
      std::fill_n(out.begin(), size, kNone);
      return;
    }
    // Read the envelope from left to right.
    int at = 0;
    for (int x = 0; x < size; ++x) {
      while (begins_[at + 1] < x) ++at;
      const double along = x - apex_[at];
      out[x] = along * along + heights[apex_[at]];
    }
  }

  static constexpr double kNone = 1e18;

 private:
  std::vector<int> apex_;
  std::vector<double> begins_;  // the x from which each parabola is the lowest
};

// Computes every pixel's squared distance to the nearest pixel whose mask value is `value`.
std::vector<double> SquaredDistancesTo(const Mask& mask, std::uint8_t value) {
  const int width = mask.width, height = mask.height;
  const int longest = std::max(width, height);
  std::vector<double> squared(mask.pixels.size());
  // Along each column, count the steps to the nearest pixel of that value, above and below. All columns advance row by
  // row.
  std::vector<double> steps(width, Envelope::kNone);
  const auto walk = [&](int y, const auto& take) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      steps[x] = mask.pixels[i] == value ? 0 : steps[x] + 1;
      take(squared[i], steps[x]);
    }
  };
  for (int y = 0; y < height; ++y) walk(y, [](double& above, double count) { above = count; });
  steps.assign(width, Envelope::kNone);
  for (int y = height - 1; y >= 0; --y) {
    walk(y, [](double& nearest, double below) {
      nearest = std::min(nearest, below);
      nearest = nearest >= Envelope::kNone ? Envelope::kNone : nearest * nearest;
    });
  }
  // Along each row, combine the columns' squared distances by the lower envelope.
  Envelope envelope(longest);
  std::vector<double> row(longest), out(longest);
  for (int y = 0; y < height; ++y) {
    double* const begin = squared.data() + static_cast<std::size_t>(y) * width;
    std::copy_n(begin, width, row.begin());
    envelope.Fill(row, width, out);
    std::copy_n(out.begin(), width, begin);
  }
  return squared;
}

}  // namespace

Image<float> SignedDistances(const Mask& mask) {
  const std::vector<double> to_set = SquaredDistancesTo(mask, 1), to_unset = SquaredDistancesTo(mask, 0);
  Image<float> distances(mask.width, mask.height);
  const double farthest = mask.width + mask.height;
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    const bool inside = mask.pixels[i] != 0;
    const double away = std::min(std::sqrt(inside ? to_unset[i] : to_set[i]) - 0.5, farthest);
    distances.pixels[i] = static_cast<float>(inside ? -away : away);
  }
  return distances;
}

namespace {

// Returns true if one of the four neighbours within the picture is unset. The picture's edge is not an outline.
bool IsOutline(const Mask& mask, int x, int y) {
  const auto unset = [&](int i, int j) { return mask.Contains(i, j) && mask.At(i, j) == 0; };
  return unset(x - 1, y) || unset(x + 1, y) || unset(x, y - 1) || unset(x, y + 1);
}

// Returns the unit normal that points out of the mask: away from the mean of the set pixels in a window around the
// pixel.
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
  int left, top, right, bottom;  // right and bottom are exclusive
};

// Returns the box around all set pixels, with a margin, clipped to the picture. Returns an empty box if no pixel is
// set.
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

// Returns the pixels whose signed distance is at most `distance`: a dilation, or an erosion for a negative value. A
// dilation keeps all set pixels, and an erosion keeps all unset pixels, so only one of the two distance maps is needed.
Mask Grown(const Mask& mask, double distance) {
  const bool erodes = distance < 0;
  const std::vector<double> squared = SquaredDistancesTo(mask, erodes ? 0 : 1);
  Mask grown = mask;
  for (std::size_t i = 0; i < grown.pixels.size(); ++i) {
    if ((mask.pixels[i] != 0) != erodes) continue;
    const auto away = static_cast<float>(std::sqrt(squared[i]) - 0.5);
    grown.pixels[i] = (erodes ? -away : away) <= distance;
  }
  return grown;
}

// Removes parts that are thinner than a disc of this radius (morphological opening).
Mask Opened(const Mask& mask, double radius) {
  if (radius <= 0) return mask;
  return Grown(Grown(mask, -radius), radius);
}

// Fills `made.outline`, `made.area` and `made.centre`.
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
      // Keep the first outline pixel of each square of the grid.
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

OutlineColumns MakeColumns(const std::vector<OutlinePoint>& outline) {
  OutlineColumns columns;
  if (outline.empty()) return columns;
  // Sort the points along a Morton curve of 8-pixel squares, which keeps neighbours in the picture together in memory.
  constexpr double kSquare = 8;  // pixels
  const auto key = [&](int point) {
    const glm::dvec2 square = glm::max(outline[static_cast<std::size_t>(point)].pixel / kSquare, glm::dvec2(0));
    const auto x = static_cast<std::uint32_t>(square.x), y = static_cast<std::uint32_t>(square.y);
    std::uint64_t code = 0;
    for (int bit = 0; bit < 16; ++bit) {
      code |= std::uint64_t{x >> bit & 1} << (2 * bit) | std::uint64_t{y >> bit & 1} << (2 * bit + 1);
    }
    return code;
  };
  std::vector<std::pair<std::uint64_t, int>> order;
  for (int i = 0; i < std::ssize(outline); ++i) order.emplace_back(key(i), i);
  std::ranges::sort(order);
  columns.places.resize(outline.size());
  for (const auto& [code, point] : order) {
    columns.places[static_cast<std::size_t>(point)] = static_cast<int>(columns.u.size());
    columns.u.push_back(outline[static_cast<std::size_t>(point)].pixel.x);
    columns.v.push_back(outline[static_cast<std::size_t>(point)].pixel.y);
  }
  while (columns.u.size() % kBlockPoints != 0) {
    columns.u.push_back(columns.u.back());
    columns.v.push_back(columns.v.back());
  }
  // Compute a circle around each block.
  for (std::size_t first = 0; first < columns.u.size(); first += kBlockPoints) {
    glm::dvec2 centre(0);
    for (std::size_t i = first; i < first + kBlockPoints; ++i) centre += glm::dvec2(columns.u[i], columns.v[i]);
    centre /= static_cast<double>(kBlockPoints);
    double radius = 0;
    for (std::size_t i = first; i < first + kBlockPoints; ++i) {
      radius = std::max(radius, glm::distance(centre, glm::dvec2(columns.u[i], columns.v[i])));
    }
    columns.centre_u.push_back(centre.x);
    columns.centre_v.push_back(centre.y);
    columns.radius.push_back(radius);
  }
  return columns;
}

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
  made.columns = MakeColumns(made.outline);
  return made;
}

DistanceAt DistanceAtPixel(const Silhouette& silhouette, const glm::dvec2& pixel) {
  assert(silhouette.area > 0);
  const Image<float>& field = silhouette.distances;
  // Clamp the pixel to the picture, then to the box that holds distances.
  const glm::dvec2 wanted = pixel / silhouette.mask_pixel - 0.5;
  const glm::dvec2 seen = glm::clamp(wanted, glm::dvec2(0), glm::dvec2(silhouette.width - 1, silhouette.height - 1));
  const glm::dvec2 in_box = seen - glm::dvec2(silhouette.left, silhouette.top);
  const glm::dvec2 at = glm::clamp(in_box, glm::dvec2(0), glm::dvec2(field.width - 1, field.height - 1));
  // Interpolate the distance and its gradient between the four pixel centres.
  const int x = std::min(static_cast<int>(at.x), field.width - 2),
            y = std::min(static_cast<int>(at.y), field.height - 2);
  const double s = at.x - x, t = at.y - y;
  const double a = field.At(x, y), b = field.At(x + 1, y), c = field.At(x, y + 1), d = field.At(x + 1, y + 1);
  DistanceAt found{(1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d),
                   {(1 - t) * (b - a) + t * (d - c), (1 - s) * (c - a) + s * (d - b)}};
  // Set the gradient to 0 along each axis on which the point was clamped.
  const glm::dvec2 beyond = in_box - at;
  for (int axis = 0; axis < 2; ++axis) {
    if (beyond[axis] != 0 || seen[axis] != wanted[axis]) found.gradient[axis] = 0;
  }
  // Outside the box, add the distance to the box.
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
