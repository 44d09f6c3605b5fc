#include "sim/camera/defocus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSlope = 0.0875;  // five degrees: the edge passes through pixels at all phases

ColourImage SlantedEdge(const CameraEffects& effects) {
  CameraModel model = ModelOf(effects, PlainCamera(200, 160));
  return Shoot(model, [](int x, int y, double) {
    const bool dark = x + 0.5 < 100 + kSlope * (y + 0.5 - 80);
    return dark ? Rgb8{60, 60, 60} : Rgb8{200, 200, 200};
  });
}

// ISO 12233's way: pixels are laid along the edge's normal into quarter-pixel bins (edge spread function), whose
// differences (line spread function) are transformed. The frequency at which half of the contrast is left, cycles per
// pixel across the edge.
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

// exp(−2π²σ²f²) = ½
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

}  // namespace
}  // namespace etude
