#include "engine/boards/corner_grid.h"

#include <cmath>
#include <deque>
#include <limits>
#include <optional>

namespace etude {
namespace {

constexpr double kLargestSpacing = 150;  // pixels
constexpr double kAlong = 0.97;          // cosine of 14°: how straight an edge leads to the next corner
constexpr double kAlike = 0.9;           // cosine of 26°: how far edges turn from a corner to the next
constexpr double kNear = 0.25;           // of the last step: how well two corners foretell the third
constexpr double kLongestStep = 2.2;     // of the last step, along another line

struct Axes {
  glm::dvec2 right, down;
};

// The saddle's edges as the axes of a corner with a bright or a dark square below right; of the two ways to name them
// the one like `expected`, or nothing.
std::optional<Axes> AxesLike(const Saddle& saddle, bool is_bright, const Axes& expected) {
  Axes axes = is_bright ? Axes{saddle.edges[0], saddle.edges[1]} : Axes{-saddle.edges[1], saddle.edges[0]};
  if (glm::dot(axes.right, expected.right) < 0) axes = {-axes.right, -axes.down};
  if (glm::dot(axes.right, expected.right) < kAlike || glm::dot(axes.down, expected.down) < kAlike) return {};
  return axes;
}

// Whether the picture is bright on one side of the line from a to b and dark on the other, all along.
bool IsEdge(const GreyImage& picture, const glm::dvec2& a, const glm::dvec2& b) {
  constexpr double kAside = 1.5;  // pixels
  constexpr double kFaintest = 15;
  const glm::dvec2 along = b - a;
  const glm::dvec2 aside = kAside / glm::length(along) * glm::dvec2(-along.y, along.x);
  int brighter = 0, darker = 0;
  constexpr int kSamples = 7;
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec2 point = a + (0.2 + 0.6 * i / (kSamples - 1)) * along;
    const double step = BrightnessAt(picture, point + aside) - BrightnessAt(picture, point - aside);
    brighter += step > kFaintest;
    darker += step < -kFaintest;
  }
  return brighter == kSamples || darker == kSamples;
}

class Grower {
 public:
  Grower(const GreyImage& picture, const std::vector<Saddle>& saddles, const std::vector<bool>& taken)
      : picture_(picture), saddles_(saddles), used_(taken) {}

  CornerGrid Grow(std::size_t seed) {
    Put({0, 0}, seed, {saddles_[seed].edges[0], saddles_[seed].edges[1]});
    while (!open_.empty()) {
      const GridPlace place = open_.front();
      open_.pop_front();
      for (const auto& [di, dj] : {GridPlace{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) Step(place, di, dj);
    }
    return grid_;
  }

 private:
  void Put(const GridPlace& place, std::size_t saddle, const Axes& axes) {
    grid_[place] = saddle;
    axes_[place] = axes;
    used_[saddle] = true;
    open_.push_back(place);
  }

  std::optional<glm::dvec2> PixelAt(int i, int j) const {
    const auto found = grid_.find({i, j});
    return found == grid_.end() ? std::nullopt : std::optional(saddles_[found->second].pixel);
  }

  // The nearest unused saddle that looks like the corner at `to` and that `may_be` it.
  template <typename MayBe>
  void PutNearest(const GridPlace& to, const Axes& expected, const glm::dvec2& from, MayBe may_be) {
    std::optional<std::size_t> best;
    Axes best_axes{};
    double least = std::numeric_limits<double>::infinity();
    const bool is_bright = (to.first + to.second) % 2 == 0;
    for (std::size_t k = 0; k < saddles_.size(); ++k) {
      const double distance = glm::distance(saddles_[k].pixel, from);
      if (used_[k] || distance >= least || !may_be(saddles_[k].pixel)) continue;
      const auto axes = AxesLike(saddles_[k], is_bright, expected);
      if (!axes) continue;
      best = k;
      best_axes = *axes;
      least = distance;
    }
    if (best) Put(to, *best, best_axes);
  }

  void Step(const GridPlace& place, int di, int dj) {
    const auto [i, j] = place;
    const GridPlace to{i + di, j + dj};
    if (grid_.contains(to)) return;
    const glm::dvec2 pixel = *PixelAt(i, j);
    const Axes axes = axes_.at(place);
    if (const auto behind = PixelAt(i - di, j - dj)) {
      const glm::dvec2 foretold = 2.0 * pixel - *behind;
      const double near = kNear * glm::distance(pixel, *behind);
      PutNearest(to, axes, foretold,
                 [&](const glm::dvec2& p) { return glm::distance(p, foretold) < near && IsEdge(picture_, pixel, p); });
      return;
    }
    const glm::dvec2 along = di != 0 ? static_cast<double>(di) * axes.right : static_cast<double>(dj) * axes.down;
    const double farthest = LongestStepFrom(i, j);
    PutNearest(to, axes, pixel, [&](const glm::dvec2& p) {
      const double distance = glm::distance(p, pixel);
      return distance < farthest && glm::dot(p - pixel, along) > kAlong * distance && IsEdge(picture_, pixel, p);
    });
  }

  double LongestStepFrom(int i, int j) const {
    for (const auto& [di, dj] : {GridPlace{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      if (const auto other = PixelAt(i + di, j + dj)) return kLongestStep * glm::distance(*PixelAt(i, j), *other);
    }
    return kLargestSpacing;
  }

  const GreyImage& picture_;
  const std::vector<Saddle>& saddles_;
  std::vector<bool> used_;
  CornerGrid grid_;
  std::map<GridPlace, Axes> axes_;
  std::deque<GridPlace> open_;
};

}  // namespace

CornerGrid GrowGrid(const GreyImage& picture, const std::vector<Saddle>& saddles, std::size_t seed,
                    const std::vector<bool>& taken) {
  return Grower(picture, saddles, taken).Grow(seed);
}

}  // namespace etude
