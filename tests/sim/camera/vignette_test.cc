#include "sim/camera/vignette.h"

#include <gtest/gtest.h>

#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

// Of a flat field: the exponent with which light falls off with 1 / cos² of the angle to the axis.
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

}  // namespace
}  // namespace etude
