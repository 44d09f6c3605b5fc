#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/silhouettes/silhouette.h"

namespace etude {
namespace {

// Sets about one pixel in `one_in` by a small congruential generator.
Mask Scattered(int width, int height, std::uint32_t seed, std::uint32_t one_in) {
  Mask mask(width, height);
  for (std::uint8_t& pixel : mask.pixels) {
    seed = seed * 1664525u + 1013904223u;
    pixel = (seed >> 16) % one_in == 0;
  }
  return mask;
}

// Returns the distance by its definition, pixel against pixel.
double BruteForce(const Mask& mask, int x, int y) {
  const bool inside = mask.At(x, y) != 0;
  double nearest = 1e18;
  for (int j = 0; j < mask.height; ++j) {
    for (int i = 0; i < mask.width; ++i) {
      if ((mask.At(i, j) != 0) != inside) nearest = std::min(nearest, std::hypot(i - x, j - y));
    }
  }
  const double away = std::min(nearest - 0.5, double{0} + mask.width + mask.height);
  return inside ? -away : away;
}

TEST(DistanceTransform, AgreesWithTheDefinitionPixelAgainstPixel) {
  int checked = 0;
  for (const std::uint32_t one_in : {1u, 2u, 9u, 60u, 100000u}) {
    for (const auto& [width, height] : {std::pair(23, 17), std::pair(1, 19), std::pair(31, 1), std::pair(8, 40)}) {
      const Mask mask = Scattered(width, height, 7 + one_in, one_in);
      const Image<float> distances = SignedDistances(mask);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          ASSERT_FLOAT_EQ(distances.At(x, y), static_cast<float>(BruteForce(mask, x, y)))
              << x << ' ' << y << " of " << width << " x " << height << ", one in " << one_in;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 3000);
}

Mask Disc(int width, int height, double u, double v, double radius) {
  Mask mask(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) mask.At(x, y) = std::hypot(x + 0.5 - u, y + 0.5 - v) <= radius;
  }
  return mask;
}

TEST(Silhouette, OfADiscTellsItsMiddleItsOutlineAndHowFarEverythingIs) {
  // A mask of half the picture's size; lengths are in the picture's pixels.
  const Silhouette disc = MakeSilhouette(Disc(90, 80, 50, 40, 15), {.mask_pixel = 2, .spacing = 3});
  EXPECT_NEAR(disc.centre.x, 100, 1e-9);
  EXPECT_NEAR(disc.centre.y, 80, 1e-9);
  EXPECT_GT(disc.outline.size(), 20u);
  for (const OutlinePoint& point : disc.outline) {
    const glm::dvec2 out = point.pixel - disc.centre;
    EXPECT_NEAR(glm::length(out), 30, 1.6);
    EXPECT_GT(glm::dot(point.normal, glm::normalize(out)), 0.95);
  }
  for (const glm::dvec2 pixel :
       {glm::dvec2(100, 80.7), glm::dvec2(120, 95), glm::dvec2(150, 80), glm::dvec2(100, 140)}) {
    const DistanceAt at = DistanceAtPixel(disc, pixel);
    EXPECT_NEAR(at.distance, glm::distance(pixel, disc.centre) - 30, 2);
  }
}

TEST(Silhouette, GradientsAreThoseOfTheDistance) {
  const Silhouette disc = MakeSilhouette(Disc(90, 80, 50, 40, 15), {.mask_pixel = 2});
  constexpr double kStep = 1e-5;
  // Points inside, outside in the box, beyond the box at a side and a corner, and outside the picture at two sides.
  for (const glm::dvec2 pixel : {glm::dvec2(103.3, 84.1), glm::dvec2(133.3, 80.2), glm::dvec2(20.4, 85.3),
                                 glm::dvec2(10.3, 10.7), glm::dvec2(-20.0, 83.3), glm::dvec2(203.1, 170.3)}) {
    const DistanceAt at = DistanceAtPixel(disc, pixel);
    for (int axis = 0; axis < 2; ++axis) {
      glm::dvec2 step(0);
      step[axis] = kStep;
      const double slope =
          (DistanceAtPixel(disc, pixel + step).distance - DistanceAtPixel(disc, pixel - step).distance) / (2 * kStep);
      EXPECT_NEAR(at.gradient[axis], slope, 1e-6) << pixel.x << ' ' << pixel.y;
    }
  }
  EXPECT_EQ(DistanceAtPixel(disc, {-20, 83}).gradient.x, 0) << "what leaves the picture is not pulled back";
}

TEST(Silhouette, OfNobodyTellsNothing) {
  const Silhouette nobody = MakeSilhouette(Mask(30, 20));
  EXPECT_EQ(nobody.area, 0);
  EXPECT_TRUE(nobody.outline.empty());
}

}  // namespace
}  // namespace etude
