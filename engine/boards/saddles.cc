#include "engine/boards/saddles.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace etude {
namespace {

constexpr int kBorder = 7;                     // width of the picture's margin that is not searched, pixels
constexpr int kNeighbourhood = 3;              // radius within which a saddle must be the strongest, pixels
constexpr double kMinRelativeStrength = 0.02;  // minimum strength as a share of the strongest saddle's
// Minimum strength, (grey levels per pixel²)²; weaker saddles are camera noise.
constexpr double kMinStrength = 60;
constexpr int kRefineReachPx = 5;
constexpr int kRefineSteps = 8;
constexpr double kConvergedPx = 0.01;
constexpr double kMaxMovePx = 2;  // maximum distance between a saddle before and after refinement

// Smooths along one axis with the binomial weights 1 4 6 4 1.
GreyImage SmoothAlong(const GreyImage& picture, int dx, int dy) {
  GreyImage smooth(picture.width, picture.height);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto at = [&](int k) {
        return picture.At(std::clamp(x + k * dx, 0, picture.width - 1), std::clamp(y + k * dy, 0, picture.height - 1));
      };
      smooth.At(x, y) = (at(-2) + at(2) + 4 * (at(-1) + at(1)) + 6 * at(0)) / 16;
    }
  }
  return smooth;
}

GreyImage Smooth(const GreyImage& picture) { return SmoothAlong(SmoothAlong(picture, 1, 0), 0, 1); }

// The second derivatives of brightness at a pixel.
struct Hessian {
  double xx, xy, yy;
  /// The strength is positive at a saddle, where the curvatures have opposite signs.
  double SaddleStrength() const { return xy * xy - xx * yy; }
};

Hessian HessianAt(const GreyImage& p, int x, int y) {
  return {p.At(x + 1, y) - 2.0 * p.At(x, y) + p.At(x - 1, y),
          0.25 * (p.At(x + 1, y + 1) - p.At(x + 1, y - 1) - p.At(x - 1, y + 1) + p.At(x - 1, y - 1)),
          p.At(x, y + 1) - 2.0 * p.At(x, y) + p.At(x, y - 1)};
}

bool IsStrongestAround(const GreyImage& strengths, int x, int y) {
  const float own = strengths.At(x, y);
  for (int v = y - kNeighbourhood; v <= y + kNeighbourhood; ++v) {
    for (int u = x - kNeighbourhood; u <= x + kNeighbourhood; ++u) {
      const float other = strengths.At(u, v);
      if (other > own || (other == own && (v < y || (v == y && u < x)))) return false;
    }
  }
  return true;
}

// Returns the saddle at (x, y). Its edges are the directions (cos a, sin a) in which the curvature is zero:
// xx cos² a + 2 xy cos a sin a + yy sin² a = 0.
Saddle Describe(const Hessian& hessian, double x, double y) {
  // In the frame of the principal directions, with curvatures k1 > 0 and −k2 < 0, the condition is
  // k1 cos² a − k2 sin² a = 0.
  const double mean = 0.5 * (hessian.xx + hessian.yy), half = std::hypot(0.5 * (hessian.xx - hessian.yy), hessian.xy);
  // Compute the direction of the largest curvature.
  const double bright = 0.5 * std::atan2(2 * hessian.xy, hessian.xx - hessian.yy);
  const double open = std::atan(std::sqrt((half + mean) / (half - mean)));
  const auto along = [](double angle) { return glm::dvec2(std::cos(angle), std::sin(angle)); };
  return {{x, y}, {along(bright - open), along(bright + open)}, hessian.SaddleStrength()};
}

// Refines a saddle to the point p nearest to all edges around it: an edge with gradient g at pixel q is the line g · (p
// − q) = 0.
std::optional<glm::dvec2> Refine(const GreyImage& picture, const glm::dvec2& found) {
  glm::dvec2 pixel = found;
  for (int step = 0; step < kRefineSteps; ++step) {
    glm::dmat2 sum(0);
    glm::dvec2 right(0);
    const int x0 = static_cast<int>(std::floor(pixel.x)), y0 = static_cast<int>(std::floor(pixel.y));
    if (x0 < kBorder || y0 < kBorder || x0 >= picture.width - kBorder || y0 >= picture.height - kBorder) return {};
    // Add up the equations of all gradients nearby; the nearer a gradient is, the larger is its weight.
    for (int y = y0 - kRefineReachPx; y <= y0 + kRefineReachPx; ++y) {
      for (int x = x0 - kRefineReachPx; x <= x0 + kRefineReachPx; ++x) {
        const glm::dvec2 q(x + 0.5, y + 0.5);
        const glm::dvec2 gradient(0.5 * (picture.At(x + 1, y) - picture.At(x - 1, y)),
                                  0.5 * (picture.At(x, y + 1) - picture.At(x, y - 1)));
        const double far = glm::dot(q - pixel, q - pixel) / (kRefineReachPx * kRefineReachPx);
        const glm::dmat2 outer = std::exp(-4 * far) * glm::outerProduct(gradient, gradient);
        sum += outer;
        right += outer * q;
      }
    }
    // Solve the weighted least-squares problem, and iterate with the weights around the new point.
    if (!(std::abs(glm::determinant(sum)) > 1e-9)) return {};
    const glm::dvec2 next = glm::inverse(sum) * right;
    if (!(glm::distance(next, found) < kMaxMovePx)) return {};
    const double moved = glm::distance(next, pixel);
    pixel = next;
    if (moved < kConvergedPx) break;
  }
  return pixel;
}

}  // namespace

GreyImage ToGrey(const ColourImage& picture) {
  GreyImage grey(picture.width, picture.height);
  std::transform(picture.pixels.begin(), picture.pixels.end(), grey.pixels.begin(),
                 [](const Rgb8& c) { return 0.299f * c.r + 0.587f * c.g + 0.114f * c.b; });
  return grey;
}

double BrightnessAt(const GreyImage& picture, const glm::dvec2& pixel) {
  const double x = std::clamp(pixel.x - 0.5, 0.0, picture.width - 1.001);
  const double y = std::clamp(pixel.y - 0.5, 0.0, picture.height - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double s = x - i, t = y - j;
  return (1 - t) * ((1 - s) * picture.At(i, j) + s * picture.At(i + 1, j)) +
         t * ((1 - s) * picture.At(i, j + 1) + s * picture.At(i + 1, j + 1));
}

std::vector<Saddle> FindSaddles(const GreyImage& picture) {
  std::vector<Saddle> saddles;
  const GreyImage smooth = Smooth(picture);
  // Compute the strength of every pixel.
  GreyImage strengths(picture.width, picture.height);
  double strongest = 0;
  for (int y = 1; y < picture.height - 1; ++y) {
    for (int x = 1; x < picture.width - 1; ++x) {
      strengths.At(x, y) = static_cast<float>(HessianAt(smooth, x, y).SaddleStrength());
      strongest = std::max<double>(strongest, strengths.At(x, y));
    }
  }
  // Refine local maxima that are strong enough.
  const double min_strength = std::max(kMinStrength, kMinRelativeStrength * strongest);
  for (int y = kBorder; y < picture.height - kBorder; ++y) {
    for (int x = kBorder; x < picture.width - kBorder; ++x) {
      if (strengths.At(x, y) < min_strength || !IsStrongestAround(strengths, x, y)) continue;
      const auto pixel = Refine(smooth, {x + 0.5, y + 0.5});
      if (pixel) saddles.push_back(Describe(HessianAt(smooth, x, y), pixel->x, pixel->y));
    }
  }
  std::stable_sort(saddles.begin(), saddles.end(),
                   [](const Saddle& a, const Saddle& b) { return a.strength > b.strength; });
  return saddles;
}

}  // namespace etude
