#include "sim/camera/dust.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

struct Shadow {
  double x = 0, y = 0, radius = 0, depth = 0;
};

// What a technician does with a flat field: pixels that lack more than half of `strength`, in connected pieces.
std::vector<Shadow> FindShadows(const ColourImage& flat_field, double light, double strength) {
  Image<float> lacks(flat_field.width, flat_field.height);
  for (int y = 0; y < lacks.height; ++y) {
    for (int x = 0; x < lacks.width; ++x) lacks.At(x, y) = static_cast<float>(1 - LightAt(flat_field, x, y) / light);
  }
  std::vector<Shadow> shadows;
  for (int y = 0; y < lacks.height; ++y) {
    for (int x = 0; x < lacks.width; ++x) {
      if (lacks.At(x, y) < strength / 2) continue;
      Shadow shadow;
      int pixels = 0;
      std::vector<std::pair<int, int>> open{{x, y}};
      while (!open.empty()) {
        const auto [px, py] = open.back();
        open.pop_back();
        if (!lacks.Contains(px, py) || lacks.At(px, py) < strength / 2) continue;
        shadow.depth = std::max<double>(shadow.depth, lacks.At(px, py));
        lacks.At(px, py) = 0;
        shadow.x += px + 0.5;
        shadow.y += py + 0.5;
        ++pixels;
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) open.push_back({px + dx, py + dy});
      }
      shadow.x /= pixels;
      shadow.y /= pixels;
      shadow.radius = std::sqrt(pixels / std::numbers::pi);
      shadows.push_back(shadow);
    }
  }
  return shadows;
}

std::vector<Shadow> ShadowsAt(double strength) {
  CameraModel model = ModelOf({.dust = strength, .noise = 0});
  return FindShadows(ShootFlat(model, {220, 220, 220}), LightOfCodes()[220], strength);
}

TEST(Dust, IsFoundInAFlatFieldWhereItLies) {
  RandomStream random(kShotWorld, "camera/dust");
  const std::vector<Speck> specks = ThrowSpecks(640, 480, random);
  const std::vector<Shadow> shadows = ShadowsAt(0.6);
  int found = 0;
  for (const Speck& speck : specks) {
    for (const Shadow& shadow : shadows) {
      const bool is_here = std::hypot(shadow.x - speck.x, shadow.y - speck.y) < 0.5;
      found += is_here && std::abs(shadow.radius / speck.radius - 1) < 0.12;
    }
  }
  EXPECT_GE(found, static_cast<int>(specks.size()) - 2) << "two may lie together, or on the edge";
  EXPECT_LE(shadows.size(), specks.size());
}

TEST(Dust, KeepsItsShareOfTheLightAway) {
  for (const double strength : {0.2, 0.5, 0.9}) {
    double deepest = 0;
    for (const Shadow& shadow : ShadowsAt(strength)) deepest = std::max(deepest, shadow.depth);
    EXPECT_NEAR(deepest / strength, 1, 0.03) << strength;
  }
  CameraModel clean = ModelOf(NoEffects());
  EXPECT_TRUE(FindShadows(ShootFlat(clean, {220, 220, 220}), LightOfCodes()[220], 0.1).empty());
}

TEST(Dust, LiesWhereItLiesWhateverItsStrength) {
  const std::vector<Shadow> weak = ShadowsAt(0.4), strong = ShadowsAt(0.8);
  ASSERT_EQ(weak.size(), strong.size());
  for (std::size_t i = 0; i < weak.size(); ++i) EXPECT_NEAR(weak[i].x, strong[i].x, 0.3);
}

}  // namespace
}  // namespace etude
