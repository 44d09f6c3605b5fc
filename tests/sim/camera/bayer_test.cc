#include "sim/camera/bayer.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

using Scene3 = std::function<Light(double x, double y)>;

LightImage ThroughBayer(int width, int height, const Scene3& scene) {
  Mosaic mosaic(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Light light = scene(x, y);
      mosaic.At(x, y) = std::array{light.r, light.g, light.b}[static_cast<std::size_t>(BayerColour(x, y))];
    }
  }
  LightImage out(width, height);
  Demosaic(mosaic, out);
  return out;
}

TEST(Bayer, HasTwiceAsMuchGreenAsRedAndBlue) {
  int count[3] = {};
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) ++count[BayerColour(x, y)];
  }
  EXPECT_EQ(count[0], 16);
  EXPECT_EQ(count[1], 32);
  EXPECT_EQ(count[2], 16);
}

TEST(Bayer, KeepsConstantPicturesToTheLastBit) {
  for (const int width : {7, 8}) {
    const LightImage out = ThroughBayer(width, 6, [](double, double) { return Light{0.7f, 0.3f, 0.11f, 0}; });
    for (const Light& pixel : out.pixels) {
      EXPECT_EQ(pixel.r, 0.7f);
      EXPECT_EQ(pixel.g, 0.3f);
      EXPECT_EQ(pixel.b, 0.11f);
    }
  }
}

TEST(Bayer, IsExactOnRampsWithinThePicture) {
  const auto ramp = [](double x, double y) {
    return Light{static_cast<float>(0.1 + 0.01 * x + 0.005 * y), static_cast<float>(0.9 - 0.01 * x),
                 static_cast<float>(0.2 + 0.02 * y), 0};
  };
  const LightImage out = ThroughBayer(20, 16, ramp);
  for (int y = 1; y < 15; ++y) {
    for (int x = 1; x < 19; ++x) {
      EXPECT_NEAR(out.At(x, y).r, ramp(x, y).r, 1e-6);
      EXPECT_NEAR(out.At(x, y).g, ramp(x, y).g, 1e-6);
      EXPECT_NEAR(out.At(x, y).b, ramp(x, y).b, 1e-6);
    }
  }
}

// The textbook's convolution with [1 2 1; 2 4 2; 1 2 1]/4 of the pixels that have the colour, green with a cross.
TEST(Bayer, IsTheConvolutionOfTheTextbook) {
  constexpr int kSide = 13;
  RandomStream random(kShotWorld, "bayer");
  Mosaic mosaic(kSide, kSide);
  for (float& value : mosaic.pixels) value = static_cast<float>(random.Uniform());
  LightImage out(kSide, kSide);
  Demosaic(mosaic, out);
  const auto mirrored = [](int i) { return i < 0 ? -i : i >= kSide ? 2 * kSide - 2 - i : i; };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      double sum[3] = {};
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int colour = BayerColour(mirrored(x + dx), mirrored(y + dy));
          const double cross = dx != 0 && dy != 0 ? 0 : dx == 0 && dy == 0 ? 4 : 1;
          const double weight = colour == 1 ? cross : (2 - std::abs(dx)) * (2 - std::abs(dy));
          sum[colour] += weight / 4 * mosaic.At(mirrored(x + dx), mirrored(y + dy));
        }
      }
      EXPECT_NEAR(out.At(x, y).r, sum[0], 1e-6);
      EXPECT_NEAR(out.At(x, y).g, sum[1], 1e-6);
      EXPECT_NEAR(out.At(x, y).b, sum[2], 1e-6);
    }
  }
}

// A grey grating, f cycles per pixel: where red is the mean of its neighbours on either side, cos 2πf of its contrast
// is left. From that, how much of the picture came through the mosaic.
double ShareOfBayer(double strength) {
  constexpr double kCycles = 0.11;
  CameraModel model = ModelOf({.bayer = strength, .noise = 0}, PlainCamera(200, 40));
  const auto grating = [](int x, int, double) {
    const auto code = static_cast<std::uint8_t>(std::lround(130 + 90 * std::cos(2 * std::numbers::pi * kCycles * x)));
    return Rgb8{code, code, code};
  };
  const ColourImage seen = Shoot(model, grating);
  // Against what the mosaic alone makes of it: own value x, neighbours' mean m; seen = x + share (m − x).
  double product = 0, square = 0;
  for (int y = 2; y < 38; y += 2) {
    for (int x = 3; x < 197; x += 2) {
      const double own = LightOfCodes()[grating(x, y, 0).r];
      const double mean = 0.5 * (LightOfCodes()[grating(x - 1, y, 0).r] + LightOfCodes()[grating(x + 1, y, 0).r]);
      product += (LightAt(seen, x, y, 'r') - own) * (mean - own);
      square += (mean - own) * (mean - own);
    }
  }
  return product / square;
}

TEST(Bayer, IsRecoveredFromTheContrastOfAGrating) {
  for (const double strength : {0.25, 0.5, 1.0}) EXPECT_NEAR(ShareOfBayer(strength), strength, 0.02);
  EXPECT_NEAR(ShareOfBayer(0), 0, 1e-9);
  EXPECT_GT(ShareOfBayer(0.6), 0.55);
}

TEST(Bayer, LosesTheContrastOfAGratingInClosedForm) {
  constexpr double kCycles = 0.1;
  const auto grating = [](double x, double) {
    const auto value = static_cast<float>(0.5 + 0.4 * std::cos(2 * std::numbers::pi * kCycles * x));
    return Light{value, value, value, 0};
  };
  const LightImage out = ThroughBayer(101, 9, grating);
  for (int x = 3; x < 98; x += 2) {
    const double left = std::cos(2 * std::numbers::pi * kCycles) * 0.4 * std::cos(2 * std::numbers::pi * kCycles * x);
    EXPECT_NEAR(out.At(x, 4).r, 0.5 + left, 1e-6);
  }
}

TEST(Bayer, FringesEdgesWithColour) {
  const auto edge = [](double x, double) { return x < 10 ? Light{0, 0, 0, 0} : Light{1, 1, 1, 0}; };
  const LightImage out = ThroughBayer(20, 8, edge);
  EXPECT_FLOAT_EQ(out.At(9, 4).r, 0.5f) << "between a dark and a bright red";
  EXPECT_FLOAT_EQ(out.At(9, 4).g, 0) << "a green pixel of its own";
  EXPECT_EQ(out.At(5, 4).r, out.At(5, 4).g) << "no fringe away from it";
}

// The throws of a pixel's own colour are those that it has without a mosaic.
TEST(Bayer, KeepsTheNoiseOfTheColoursThatAreThere) {
  CameraModel full = ModelOf({.vignette = 1, .noise = 1}, PlainCamera(64, 48));
  CameraModel mosaic = ModelOf({.vignette = 1, .bayer = 1, .noise = 1}, PlainCamera(64, 48));
  const ColourImage a = ShootFlat(full, {140, 140, 140}), b = ShootFlat(mosaic, {140, 140, 140});
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const int colour = BayerColour(x, y);
      const auto value = [&](const Rgb8& pixel) {
        return std::array{pixel.r, pixel.g, pixel.b}[static_cast<std::size_t>(colour)];
      };
      ASSERT_EQ(value(a.At(x, y)), value(b.At(x, y)));
    }
  }
}

}  // namespace
}  // namespace etude
