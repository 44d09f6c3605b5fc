#include "sim/camera/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/camera/sensor.h"
#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

struct Statistics {
  double mean = 0, variance = 0;
};

// Of one colour, in linear light.
Statistics Measure(const ColourImage& picture, char colour) {
  double sum = 0, squares = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double light = LightAt(picture, x, y, colour);
      sum += light;
      squares += light * light;
    }
  }
  const double count = static_cast<double>(picture.pixels.size());
  return {sum / count, squares / count - sum * sum / count / count};
}

// What rounding to a code adds: a twelfth of the square of a code's width in light.
double RoundingVariance(int code) {
  const double width =
      (LightOfCodes()[static_cast<std::size_t>(code + 1)] - LightOfCodes()[static_cast<std::size_t>(code - 1)]) / 2;
  return width * width / 12;
}

// The photon transfer curve (Janesick): of flat fields, the variance against the mean; its slope is the light of one
// electron, its intercept the variance of reading.
Line PhotonTransfer(const CameraEffects& effects) {
  std::vector<std::pair<double, double>> points;
  CameraModel model = ModelOf(effects);
  for (const std::uint8_t code : {90, 110, 130, 150, 170, 190, 210}) {
    const Statistics seen = Measure(ShootFlat(model, {code, code, code}, code), 'g');
    points.push_back({seen.mean, seen.variance - RoundingVariance(code)});
  }
  return FitLine(points);
}

TEST(SensorNoise, GivesItsElectronsBackByThePhotonTransferCurve) {
  for (const double strength : {0.5, 1.0}) {
    for (const double gain_db : {12.0, 18.0}) {
      const Line curve = PhotonTransfer({.gain_db = gain_db, .noise = strength});
      const double gain = std::pow(10, gain_db / 20), square = strength * strength;
      EXPECT_NEAR(curve.slope / (square * gain / 3000), 1, 0.03) << strength << " at " << gain_db << " dB";
      EXPECT_NEAR(std::sqrt(std::max(curve.intercept, 0.0)) / (strength * gain * 3 / 3000), 1, 0.25)
          << strength << " at " << gain_db << " dB";
    }
  }
}

TEST(SensorNoise, OfAnotherStrengthOrGainHasAnotherCurve) {
  const double usual = PhotonTransfer({.gain_db = 12}).slope;
  EXPECT_GT(PhotonTransfer({.gain_db = 12, .noise = 1.1}).slope / usual, 1.15);
  EXPECT_GT(PhotonTransfer({.gain_db = 14}).slope / usual, 1.15);
}

TEST(SensorNoise, LeavesTheMeanAlone) {
  CameraModel model = ModelOf({.noise = 1});
  const ColourImage picture = ShootFlat(model, {80, 128, 220});
  EXPECT_NEAR(Measure(picture, 'r').mean, LightOfCodes()[80], 1e-4);
  EXPECT_NEAR(Measure(picture, 'g').mean, LightOfCodes()[128], 1e-4);
  EXPECT_NEAR(Measure(picture, 'b').mean, LightOfCodes()[220], 2e-4);
}

TEST(SensorNoise, IsIndependentBetweenColoursAndNeighbours) {
  CameraModel model = ModelOf({.noise = 2});
  const ColourImage noisy = ShootFlat(model, {128, 128, 128});
  double colours = 0, neighbours = 0, self = 0;
  for (std::size_t i = 0; i + 1 < noisy.pixels.size(); ++i) {
    const double red = noisy.pixels[i].r - 128.0, green = noisy.pixels[i].g - 128.0;
    colours += red * green;
    neighbours += red * (noisy.pixels[i + 1].r - 128.0);
    self += red * red;
  }
  EXPECT_LT(std::abs(colours / self), 0.01);
  EXPECT_LT(std::abs(neighbours / self), 0.01);
}

TEST(SensorNoise, HasTheTailsOfANormalDistribution) {
  RandomStream random(kShotWorld, "normals");
  NormalRows rows(random);
  constexpr std::size_t kCount = 600000;
  const float* normals = rows.Next(kCount);
  double squares = 0;
  int beyond_two = 0, beyond_three = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    squares += double{normals[i]} * normals[i];
    beyond_two += std::abs(normals[i]) > 2;
    beyond_three += std::abs(normals[i]) > 3;
  }
  EXPECT_NEAR(squares / kCount, 1, 0.006);
  EXPECT_NEAR(beyond_two / double{kCount}, std::erfc(2 / std::sqrt(2.0)), 0.0015);
  EXPECT_NEAR(beyond_three / double{kCount}, std::erfc(3 / std::sqrt(2.0)), 0.001);
}

TEST(SensorNoise, ByTableOfCodesIsNoiseOfLight) {
  const SensorNoise noise = WebcamNoise(1.5, 3);
  ColourImage codes(67, 31), decoded(67, 31);
  for (std::size_t i = 0; i < codes.pixels.size(); ++i) {
    codes.pixels[i] = {static_cast<std::uint8_t>(i % 256), static_cast<std::uint8_t>(i / 8),
                       static_cast<std::uint8_t>(7 * i)};
  }
  LightImage light(67, 31);
  DecodeRow(codes.pixels.data(), 67 * 31, light.pixels.data());
  RandomStream one(kShotWorld, "same"), other(kShotWorld, "same");
  CodeNoise(noise).Apply(one, codes);
  Sensor{.noise = noise}.ReadColours(other, light);
  EncodeRow(light.pixels.data(), 67 * 31, decoded.pixels.data());
  EXPECT_EQ(codes.pixels, decoded.pixels);
  EXPECT_EQ(one.Bits(), other.Bits()) << "as many throws";
}

TEST(SensorNoise, ThrowsAsOftenWhateverItsStrength) {
  RandomStream weak(kShotWorld, "noise"), strong(kShotWorld, "noise");
  ColourImage one(31, 17, {9, 9, 9}), other(31, 17, {200, 0, 80});
  CodeNoise(WebcamNoise(0.1, 0)).Apply(weak, one);
  CodeNoise(WebcamNoise(9, 20)).Apply(strong, other);
  EXPECT_EQ(weak.Bits(), strong.Bits());
}

TEST(SensorNoise, OfNoStrengthIsNone) {
  EXPECT_TRUE(WebcamNoise(0, 24).IsNone());
  EXPECT_FALSE(WebcamNoise(0.1, 0).IsNone());
}

}  // namespace
}  // namespace etude
