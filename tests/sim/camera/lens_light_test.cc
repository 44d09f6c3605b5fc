#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/camera/lens.h"
#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSlope = 0.0875;  // five degrees, so that the edge crosses pixels at all phases

ColourImage SlantedEdge(const CameraEffects& effects) {
  CameraModel model = ModelOf(effects, PlainCamera(200, 160));
  return Shoot(model, [](int x, int y, double) {
    const bool dark = x + 0.5 < 100 + kSlope * (y + 0.5 - 80);
    return dark ? Rgb8{60, 60, 60} : Rgb8{200, 200, 200};
  });
}

// Measures by ISO 12233: pixels are sorted along the edge's normal into quarter-pixel bins (edge spread function); the
// differences (line spread function) are transformed. Returns the frequency with half the contrast, cycles per pixel
// across the edge.
double Mtf50(const ColourImage& picture) {
  constexpr int kReach = 24, kBins = 8 * kReach;
  std::vector<double> sum(kBins), count(kBins);
  const double across = 1 / std::hypot(1.0, kSlope);
  for (int y = 20; y < 140; ++y) {
    for (int x = 40; x < 160; ++x) {
      const double distance = (x + 0.5 - 100 - kSlope * (y + 0.5 - 80)) * across;
      const int bin = static_cast<int>(std::floor(4 * (distance + kReach)));
      if (bin < 0 || bin >= kBins) continue;
      sum[static_cast<std::size_t>(bin)] += LightAt(picture, x, y);
      count[static_cast<std::size_t>(bin)] += 1;
    }
  }
  std::vector<double> spread;
  for (std::size_t i = 1; i < kBins; ++i) spread.push_back(sum[i] / count[i] - sum[i - 1] / count[i - 1]);
  const auto contrast = [&](double frequency) {
    double real = 0, imaginary = 0, all = 0;
    for (std::size_t i = 0; i < spread.size(); ++i) {
      real += spread[i] * std::cos(2 * kPi * frequency * static_cast<double>(i) / 4);
      imaginary += spread[i] * std::sin(2 * kPi * frequency * static_cast<double>(i) / 4);
      all += spread[i];
    }
    return std::hypot(real, imaginary) / all;
  };
  double frequency = 0.002;
  while (contrast(frequency) > 0.5 && frequency < 2) frequency += 0.0005;
  return frequency;
}

// From exp(−2π²σ²f²) = ½.
double GaussianMtf50(double sigma) { return std::sqrt(std::log(2.0) / 2) / (kPi * sigma); }

TEST(Defocus, HasTheModulationTransferOfItsGaussian) {
  for (const double sigma : {1.0, 1.5, 2.5, 4.0}) {
    EXPECT_NEAR(Mtf50(SlantedEdge({.defocus_px = sigma, .noise = 0})) / GaussianMtf50(sigma), 1, 0.03) << sigma;
  }
}

TEST(Defocus, OfAnotherStrengthIsToldApart) {
  EXPECT_GT(std::abs(Mtf50(SlantedEdge({.defocus_px = 1.6, .noise = 0})) / GaussianMtf50(1.5) - 1), 0.045);
  EXPECT_GT(Mtf50(SlantedEdge({.noise = 0})), 0.5) << "a sharp edge keeps its contrast";
}

TEST(Defocus, KeepsFlatPicturesAndTheLightAtTheirEdges) {
  LightImage light(40, 30, {0.25f, 0.5f, 1, 0});
  Defocus(2.3).Apply(light);
  for (const Light& pixel : light.pixels) {
    ASSERT_NEAR(pixel.r, 0.25, 1e-6);
    ASSERT_NEAR(pixel.b, 1, 1e-6);
  }
}

TEST(Defocus, SpreadsAPointAlikeInBothDirections) {
  LightImage light(41, 41);
  light.At(20, 20) = {1, 1, 1, 0};
  Defocus(1.2).Apply(light);
  double sum = 0;
  for (int i = -5; i <= 5; ++i) {
    EXPECT_FLOAT_EQ(light.At(20 + i, 20).g, light.At(20, 20 + i).g);
    for (int j = -5; j <= 5; ++j) sum += light.At(20 + i, 20 + j).g;
  }
  EXPECT_NEAR(sum, 1, 1e-5);
}

// Returns the exponent e with which the picture of a flat field falls off as (cos⁴ α)ᵉ; α is the angle to the optical
// axis.
double FalloffOf(const CameraEffects& effects) {
  CameraModel model = ModelOf(effects, PlainCamera());
  const ColourImage picture = ShootFlat(model, {220, 220, 220});
  std::vector<std::pair<double, double>> points;
  for (int y = 0; y < 480; y += 5) {
    for (int x = 0; x < 640; x += 5) {
      const double across = (x + 0.5 - 320) / 600, down = (y + 0.5 - 240) / 600;
      points.push_back({std::log(1 + across * across + down * down), std::log(LightAt(picture, x, y))});
    }
  }
  return -FitLine(points).slope / 2;
}

TEST(Vignette, IsRecoveredFromAFlatField) {
  for (const double strength : {0.3, 1.0, 2.0}) {
    EXPECT_NEAR(FalloffOf({.vignette = strength, .noise = 0}) / strength, 1, 0.01);
  }
  EXPECT_NEAR(FalloffOf({.vignette = 1, .noise = 1}), 1, 0.03) << "through noise as well";
}

TEST(Vignette, OfAnotherStrengthIsToldApart) {
  EXPECT_NEAR(FalloffOf(NoEffects()), 0, 1e-9);
  EXPECT_GT(FalloffOf({.vignette = 1.05, .noise = 0}), 1.03);
}

TEST(Vignette, OfStrengthOneIsTheFourthPowerOfTheCosine) {
  Transmission transmission(640, 480, 1.0f);
  AddVignette(PlainCamera(), 1, transmission);
  const double cosine = 600 / std::sqrt(600.0 * 600 + 319.5 * 319.5 + 239.5 * 239.5);
  EXPECT_NEAR(transmission.At(0, 0), std::pow(cosine, 4), 1e-6);
  EXPECT_NEAR(transmission.At(320, 240), 1, 1e-5);
}

struct Shadow {
  double x = 0, y = 0, radius = 0, depth = 0;
};

// Finds shadows in a flat field: connected pixels that lack more than half of `strength`.
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
  const std::vector<Speck> specks = DrawSpecks(640, 480, random);
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
