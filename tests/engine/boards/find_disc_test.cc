#include "engine/boards/find_disc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/base/angles.h"
#include "sim/random/stream.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr float kDark = 30, kBright = 220;

/// Every pixel's mean over 64 places, of which `is_dark` are dark.
GreyImage Draw(const std::function<bool(const glm::dvec2&)>& is_dark) {
  constexpr int kRays = 8;
  GreyImage picture(90, 70);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      int dark = 0;
      for (int k = 0; k < kRays * kRays; ++k) {
        dark += is_dark({x + (k % kRays + 0.5) / kRays, y + (k / kRays + 0.5) / kRays});
      }
      picture.At(x, y) = std::lerp(kBright, kDark, static_cast<float>(dark) / (kRays * kRays));
    }
  }
  return picture;
}

struct Ellipse {
  glm::dvec2 middle, half;
  double turn = 0;

  bool operator()(const glm::dvec2& p) const {
    const glm::dvec2 d = p - middle;
    const glm::dvec2 turned(std::cos(turn) * d.x + std::sin(turn) * d.y, std::cos(turn) * d.y - std::sin(turn) * d.x);
    return glm::length(turned / half) < 1;
  }
};

TEST(FindDisc, FindsTheMiddleOfAnyEllipseThatIsPointedAt) {
  RandomStream random({.suite_seed = 3, .scenario = "disc", .trial = 0}, "test");
  for (int trial = 0; trial < 60; ++trial) {
    const Ellipse disc{{random.Uniform(30, 60), random.Uniform(30, 40)},
                       {random.Uniform(3, 9), random.Uniform(2, 5)},
                       random.Uniform(0, kPi)};
    GreyImage picture = Draw(disc);
    for (float& value : picture.pixels) value += static_cast<float>(3 * random.Normal());
    ASSERT_OK(found, FindDisc(picture, disc.middle + glm::dvec2(random.Uniform(-3, 3), 2), 6, 30)) << trial;
    EXPECT_LT(glm::distance(*found, disc.middle), 0.1) << trial;
  }
}

TEST(FindDisc, IsExactWithoutNoiseAlsoBesideAnotherDisc) {
  const Ellipse disc{{40.3, 31.8}, {5, 4}}, other{{57, 33}, {6, 6}};
  const GreyImage picture = Draw([&](const glm::dvec2& p) { return disc(p) || other(p); });
  EXPECT_LT(glm::distance(*FindDisc(picture, {42, 30}, 5, 30), disc.middle), 0.01);
  EXPECT_LT(glm::distance(*FindDisc(picture, {55, 33}, 5, 30), other.middle), 0.01);
}

TEST(FindDisc, FindsNothingThatIsNoDisc) {
  const glm::dvec2 middle(40, 35);
  const auto found = [&middle](const std::function<bool(const glm::dvec2&)>& is_dark) {
    return FindDisc(Draw(is_dark), middle, 6, 20);
  };
  EXPECT_FALSE(found([](const glm::dvec2&) { return false; })) << "an even ground";
  EXPECT_FALSE(found(Ellipse{{60, 35}, {4, 4}})) << "pointed at too far off";
  EXPECT_FALSE(found([](const glm::dvec2& p) { return p.x > 40; })) << "half the picture";
  EXPECT_FALSE(found(Ellipse{middle, {1, 1}})) << "a speck";
  EXPECT_FALSE(found([&](const glm::dvec2& p) {
    return Ellipse{middle, {9, 9}}(p) && !Ellipse{middle + glm::dvec2(4, 0), {7, 7}}(p);
  })) << "a crescent";
  EXPECT_TRUE(found(Ellipse{middle, {4, 4}}));
}

TEST(FindDisc, AsksForNothingOutsideThePicture) {
  const GreyImage picture = Draw(Ellipse{{40, 35}, {4, 4}});
  for (const glm::dvec2& far : {glm::dvec2(-50, 10), {1e12, 0}, {NAN, 3}, {90, 70}}) {
    EXPECT_FALSE(FindDisc(picture, far, 6, 30));
  }
  EXPECT_FALSE(FindDisc(GreyImage(0, 0), {0, 0}, 6, 30));
}

}  // namespace
}  // namespace etude
