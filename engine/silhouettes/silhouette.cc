#include "engine/silhouettes/silhouette.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <span>
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

// Computes every pixel's squared distance to the nearest pixel of its column that has the other mask value.
std::vector<double> SquaresAlongColumns(const Mask& mask) {
  const auto width = static_cast<std::size_t>(mask.width), height = static_cast<std::size_t>(mask.height);
  std::vector<double> squares(mask.pixels.size());
  // For each pixel, count the rows to the nearest pixel of the other value, first upwards, then downwards. All columns
  // advance row by row.
  std::vector<double> steps(width, Envelope::kNone);
  const auto walk = [&](std::size_t y, std::size_t before, const auto& take) {
    const std::uint8_t *own = &mask.pixels[y * width], *other = &mask.pixels[before * width];
    double* const row = &squares[y * width];
    for (std::size_t x = 0; x < width; ++x) {
      steps[x] = own[x] == other[x] ? steps[x] + 1 : 1;
      row[x] = take(row[x], steps[x]);
    }
  };
  for (std::size_t y = 0; y < height; ++y) walk(y, y > 0 ? y - 1 : 0, [](double, double above) { return above; });
  steps.assign(width, Envelope::kNone);
  for (std::size_t y = height; y-- > 0;) {
    walk(y, std::min(y + 1, height - 1), [](double above, double below) {
      const double nearest = std::min(above, below);
      return nearest >= Envelope::kNone ? Envelope::kNone : nearest * nearest;
    });
  }
  return squares;
}

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
    const std::uint8_t* const row = mask.pixels.data() + static_cast<std::size_t>(y) * mask.width;
    const void* const first = std::memchr(row, 1, static_cast<std::size_t>(mask.width));
    if (first == nullptr) continue;
    int last = mask.width - 1;
    while (row[last] == 0) --last;
    box = {std::min(box.left, static_cast<int>(static_cast<const std::uint8_t*>(first) - row)), std::min(box.top, y),
           std::max(box.right, last + 1), y + 1};
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

// Gives the value `kValue` to every pixel near a pixel of that value: a dilation for 1, an erosion for 0. Pixels are
// near each other if `is_near` is true for the distance from the centre of one to the border of the other, in mask
// pixels. Near pixels must be at most `reach` rows and columns apart.
template <std::uint8_t kValue, typename IsNear>
Mask Spread(const Mask& mask, int reach, const IsNear& is_near) {
  Mask out = mask;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      if ((i == 0 && j == 0) || !is_near(static_cast<float>(std::sqrt(i * i + j * j) - 0.5))) continue;
      const int left = std::max(0, -i), count = mask.width - std::abs(i);
      for (int y = std::max(0, -j); y < mask.height - std::max(0, j); ++y) {
        const std::uint8_t* from = mask.pixels.data() + static_cast<std::size_t>(y + j) * mask.width + left + i;
        std::uint8_t* to = out.pixels.data() + static_cast<std::size_t>(y) * mask.width + left;
        for (int x = 0; x < count; ++x) to[x] = kValue != 0 ? to[x] | from[x] : to[x] & from[x];
      }
    }
  }
  return out;
}

// Removes parts that are thinner than a disc of this radius (morphological opening: an erosion, then a dilation).
Mask Opened(const Mask& mask, double radius) {
  if (radius <= 0) return mask;
  const int reach = static_cast<int>(radius + 0.5) + 1;
  const Mask eroded = Spread<0>(mask, reach, [&](float away) { return away < radius; });
  return Spread<1>(eroded, reach, [&](float away) { return away <= radius; });
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

// Sorts points into blocks of neighbours: halves the set across the longer side of its box until a block is left.
void SortIntoBlocks(const std::vector<OutlinePoint>& outline, std::span<int> points) {
  if (points.size() <= kBlockPoints) return;
  glm::dvec2 low = outline[static_cast<std::size_t>(points[0])].pixel, high = low;
  for (const int point : points) {
    low = glm::min(low, outline[static_cast<std::size_t>(point)].pixel);
    high = glm::max(high, outline[static_cast<std::size_t>(point)].pixel);
  }
  const int axis = high.x - low.x < high.y - low.y;
  const std::size_t blocks = (points.size() + kBlockPoints - 1) / kBlockPoints, half = blocks / 2 * kBlockPoints;
  std::ranges::nth_element(points, points.begin() + static_cast<std::ptrdiff_t>(half), {}, [&](int point) {
    return std::pair(outline[static_cast<std::size_t>(point)].pixel[axis], point);
  });
  SortIntoBlocks(outline, points.first(half));
  SortIntoBlocks(outline, points.subspan(half));
}

}  // namespace

Image<float> SignedDistances(const Mask& mask) {
  const std::vector<double> squares = SquaresAlongColumns(mask);
  Image<float> distances(mask.width, mask.height);
  const double farthest = mask.width + mask.height;
  // For each run of equal pixels in a row, combine the distances along the columns: each column gives one parabola of
  // the envelope. The pixels directly before and after the run have the other value, so columns beyond these two pixels
  // contain no nearer pixel of that value.
  const int longest = mask.width + 2;
  Envelope envelope(longest);
  std::vector<double> heights(longest), nearest(longest);
  for (int y = 0; y < mask.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * mask.width;
    for (int begin = 0, end = 0; begin < mask.width; begin = end) {
      const bool inside = mask.pixels[row + begin] != 0;
      while (end < mask.width && (mask.pixels[row + end] != 0) == inside) ++end;
      const int size = end - begin + 2;
      heights[0] = begin > 0 ? 0 : Envelope::kNone;
      std::copy_n(&squares[row + begin], end - begin, &heights[1]);
      heights[size - 1] = end < mask.width ? 0 : Envelope::kNone;
      envelope.Fill(heights, size, nearest);
      for (int x = begin; x < end; ++x) {
        const double away = std::min(std::sqrt(nearest[x - begin + 1]) - 0.5, farthest);
        distances.pixels[row + x] = static_cast<float>(inside ? -away : away);
      }
    }
  }
  return distances;
}

OutlineColumns MakeColumns(const std::vector<OutlinePoint>& outline) {
  OutlineColumns columns;
  if (outline.empty()) return columns;
  std::vector<int> order(outline.size());
  std::iota(order.begin(), order.end(), 0);
  SortIntoBlocks(outline, order);
  columns.places.resize(outline.size());
  for (const int point : order) {
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

}  // namespace etude
