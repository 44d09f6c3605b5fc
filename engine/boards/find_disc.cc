#include "engine/boards/find_disc.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

constexpr double kMinWidthPx = 3;
constexpr double kMinDiscContrast = 20;  // grey levels (of 255)
// The maximum relative difference between a region's area and that of the ellipse with the same second moments.
constexpr double kMaxShapeError = 0.25;

// A rectangle of pixels, clipped to the picture; column `right` and row `bottom` are outside.
struct Window {
  int left, top, right, bottom;

  Window(const GreyImage& picture, const glm::dvec2& middle, double half)
      : left(std::max(static_cast<int>(std::floor(middle.x - half)), 0)),
        top(std::max(static_cast<int>(std::floor(middle.y - half)), 0)),
        right(std::min(static_cast<int>(std::ceil(middle.x + half)), picture.width)),
        bottom(std::min(static_cast<int>(std::ceil(middle.y + half)), picture.height)) {}

  bool Has(int x, int y) const { return left <= x && x < right && top <= y && y < bottom; }
};

glm::dvec2 MiddleOf(int x, int y) { return {x + 0.5, y + 0.5}; }

std::optional<glm::ivec2> FindDarkest(const GreyImage& picture, const glm::dvec2& pointer, double reach) {
  const Window window(picture, pointer, reach);
  std::optional<glm::ivec2> darkest;
  for (int y = window.top; y < window.bottom; ++y) {
    for (int x = window.left; x < window.right; ++x) {
      if (glm::distance(MiddleOf(x, y), pointer) > reach) continue;
      if (!darkest || picture.At(x, y) < picture.At(darkest->x, darkest->y)) darkest = {x, y};
    }
  }
  return darkest;
}

float BrightestOf(const GreyImage& picture, const Window& window) {
  float brightest = 0;
  for (int y = window.top; y < window.bottom; ++y) {
    for (int x = window.left; x < window.right; ++x) brightest = std::max(brightest, picture.At(x, y));
  }
  return brightest;
}

// Returns the connected pixels darker than `threshold` around `darkest`; empty if they extend beyond the window.
std::vector<glm::ivec2> DarkPiece(const GreyImage& picture, const glm::ivec2& darkest, const Window& window,
                                  float threshold) {
  const int width = window.right - window.left;
  std::vector<bool> visited(static_cast<std::size_t>(width) * static_cast<std::size_t>(window.bottom - window.top));
  std::vector<glm::ivec2> piece;
  bool is_cut = false;
  const auto visit = [&](int x, int y) {
    if (!window.Has(x, y)) {
      is_cut = true;
      return;
    }
    const auto index = static_cast<std::size_t>((y - window.top) * width + (x - window.left));
    if (visited[index] || picture.At(x, y) >= threshold) return;
    visited[index] = true;
    piece.emplace_back(x, y);
  };
  visit(darkest.x, darkest.y);
  for (std::size_t i = 0; i < piece.size() && !is_cut; ++i) {
    const glm::ivec2 p = piece[i];
    for (const glm::ivec2& step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) visit(p.x + step.x, p.y + step.y);
  }
  return is_cut ? std::vector<glm::ivec2>{} : piece;
}

// The moments of darkness in a region with its surroundings.
struct Darkness {
  double area = 0;  // pixels
  glm::dvec2 middle{0};
  double spread = 0;  // determinant of the covariance, pixels⁴

  /// The area and approximate width of an ellipse with these second moments.
  double AreaOfEllipse() const { return 4 * kPi * std::sqrt(spread); }
  double Width() const { return 4 * std::sqrt(std::sqrt(spread)); }
};

Darkness Measure(const GreyImage& picture, const std::vector<glm::ivec2>& piece) {
  // Find the bounding box, with a margin for the blurred edge.
  glm::ivec2 low = piece.front(), high = piece.front();
  std::vector<float> inside, around;
  for (const glm::ivec2& p : piece) {
    low = glm::min(low, p);
    high = glm::max(high, p);
    inside.push_back(picture.At(p.x, p.y));
  }
  constexpr int kEdge = 3;  // margin in pixels: the blurred edge, and one pixel of background
  low = glm::max(low - kEdge, glm::ivec2(0));
  high = glm::min(high + kEdge, glm::ivec2(picture.width - 1, picture.height - 1));
  // The dark level is the median inside, the bright level the median around the region.
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (x == low.x || x == high.x || y == low.y || y == high.y) around.push_back(picture.At(x, y));
    }
  }
  const float dark = UpperMedian(std::move(inside)), bright = UpperMedian(std::move(around));
  Darkness sum;
  if (!(bright > dark)) return sum;
  // Compute the moments; each pixel is weighted by its darkness.
  glm::dmat2 second(0);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const double share = std::clamp((bright - picture.At(x, y)) / (bright - dark), 0.0f, 1.0f);
      const glm::dvec2 at = MiddleOf(x - low.x, y - low.y);
      sum.area += share;
      sum.middle += share * at;
      second += share * glm::outerProduct(at, at);
    }
  }
  sum.middle /= sum.area;
  sum.spread = glm::determinant(second / sum.area - glm::outerProduct(sum.middle, sum.middle));
  sum.middle += low;
  return sum;
}

}  // namespace

std::optional<glm::dvec2> FindDisc(const GreyImage& picture, const glm::dvec2& pointer, double reach_px,
                                   double max_width_px) {
  const glm::dvec2 size(picture.width, picture.height);
  const bool is_near =
      glm::all(glm::greaterThan(pointer, glm::dvec2(-reach_px))) && glm::all(glm::lessThan(pointer, size + reach_px));
  if (!is_near) return std::nullopt;  // also true if the pointer is NaN
  // Find the region around the darkest pixel, at half contrast.
  const auto darkest = FindDarkest(picture, pointer, reach_px);
  if (!darkest) return std::nullopt;
  const Window window(picture, MiddleOf(darkest->x, darkest->y), max_width_px);
  const float dark = picture.At(darkest->x, darkest->y), bright = BrightestOf(picture, window);
  if (bright - dark < kMinDiscContrast) return std::nullopt;
  const std::vector<glm::ivec2> piece = DarkPiece(picture, *darkest, window, 0.5f * (dark + bright));
  if (piece.empty()) return std::nullopt;
  // Check its width and shape.
  const Darkness disc = Measure(picture, piece);
  if (!(disc.spread > 0) || disc.Width() < kMinWidthPx) return std::nullopt;
  if (std::abs(disc.area / disc.AreaOfEllipse() - 1) > kMaxShapeError) return std::nullopt;
  return disc.middle;
}

}  // namespace etude
