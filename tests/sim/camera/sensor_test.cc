#include "sim/camera/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
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

// Demosaicing convolves red and blue with [1 2 1; 2 4 2; 1 2 1]/4, and green with [0 1 0; 1 4 1; 0 1 0]/4.
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

// In a grey grating of f cycles per pixel, interpolating red from both neighbours leaves cos 2πf of the contrast.
// Computes from this contrast the share of the mosaic in the picture.
double ShareOfBayer(double strength) {
  constexpr double kCycles = 0.11;
  CameraModel model = ModelOf({.bayer = strength, .noise = 0}, PlainCamera(200, 40));
  const auto grating = [](int x, int, double) {
    const auto code = static_cast<std::uint8_t>(std::lround(130 + 90 * std::cos(2 * std::numbers::pi * kCycles * x)));
    return Rgb8{code, code, code};
  };
  const ColourImage seen = Shoot(model, grating);
  // For the own value x and the neighbours' mean m, the mosaic shows x + share (m − x).
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

// A pixel's own colour has the same noise with and without a mosaic.
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

struct Patch {
  double stops = 0;   ///< brightness relative to the truth
  double warmth = 0;  ///< ratio of red to blue, stops
};

// Measures a grey card in the middle of the picture, in linear light.
Patch GreyCard(CameraModel& model, std::size_t frame) {
  const ColourImage picture = ShootFlat(model, {120, 120, 120}, frame);
  double red = 0, green = 0, blue = 0;
  for (int y = 8; y < 24; ++y) {
    for (int x = 8; x < 24; ++x) {
      red += LightAt(picture, x, y, 'r');
      green += LightAt(picture, x, y, 'g');
      blue += LightAt(picture, x, y, 'b');
    }
  }
  return {std::log2(green / 256 / LightOfCodes()[120]), std::log2(red / blue)};
}

Patch GreyCard(const CameraEffects& effects) {
  CameraModel model = ModelOf(effects, PlainCamera(32, 32));
  return GreyCard(model, 0);
}

TEST(Exposure, IsRecoveredFromAGreyCard) {
  for (const double stops : {-1.5, -0.4, 0.5, 1.2}) {
    EXPECT_NEAR(GreyCard({.exposure_ev = stops, .noise = 0}).stops, stops, 0.02);
    EXPECT_NEAR(GreyCard({.exposure_ev = stops, .noise = 0}).warmth, 0, 1e-9);
  }
  EXPECT_GT(GreyCard({.exposure_ev = 0.55, .noise = 0}).stops, 0.52) << "another strength is told apart";
}

TEST(WhiteBalance, IsRecoveredFromAGreyCard) {
  for (const double warmth : {-0.8, 0.3, 1.0}) {
    EXPECT_NEAR(GreyCard({.white_balance_ev = warmth, .noise = 0}).warmth, warmth, 0.03);
    EXPECT_NEAR(GreyCard({.white_balance_ev = warmth, .noise = 0}).stops, 0, 1e-9) << "green stays";
  }
  EXPECT_GT(GreyCard({.white_balance_ev = 0.4, .noise = 0}).warmth, 0.36);
}

// Returns half the range of a value over a minute of the card's pictures.
template <typename Value>
double SwingOf(const CameraEffects& effects, Value value) {
  CameraModel model = ModelOf(effects, PlainCamera(32, 32));
  double least = 1e9, most = -1e9;
  for (std::size_t frame = 0; frame < 600; frame += 3) {
    const double now = value(GreyCard(model, frame));
    least = std::min(least, now);
    most = std::max(most, now);
  }
  return (most - least) / 2;
}

TEST(Exposure, AndWhiteBalanceWanderAsFarAsTheyShould) {
  const auto stops = [](const Patch& patch) { return patch.stops; };
  const auto warmth = [](const Patch& patch) { return patch.warmth; };
  for (const double drift : {0.2, 0.6}) {
    EXPECT_NEAR(SwingOf({.exposure_drift_ev = drift, .noise = 0}, stops), drift, 0.02);
    EXPECT_NEAR(SwingOf({.white_balance_drift_ev = drift, .noise = 0}, warmth), drift, 0.03);
  }
  EXPECT_LT(SwingOf({.white_balance_drift_ev = 0.6, .noise = 0}, stops), 1e-9);
  EXPECT_GT(SwingOf({.exposure_drift_ev = 0.25, .noise = 0}, stops), 0.225);
}

TEST(Exposure, WandersSlowly) {
  RandomStream exposure(kShotWorld, "e"), balance(kShotWorld, "w");
  const AutomaticToning toning({.exposure_drift_ev = 1, .white_balance_drift_ev = 1}, exposure, balance);
  for (int k = 0; k < 300; ++k) {
    const double step = std::abs(std::log2(toning.At((k + 1) / 30.0).exposure / toning.At(k / 30.0).exposure));
    EXPECT_LT(step, 2 * 3.1416 / 4 / 30 * 1.01) << "never faster than once in four seconds";
  }
}

// Gain compensates for less light, so only the noise differs.
TEST(Gain, LeavesThePictureAsBright) {
  EXPECT_NEAR(GreyCard({.gain_db = 12, .noise = 1}).stops, 0, 0.02);
  EXPECT_EQ(GreyCard({.gain_db = 12, .noise = 0}).stops, GreyCard(NoEffects()).stops);
}

struct Statistics {
  double mean = 0, variance = 0;
};

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

// Returns the variance of rounding to a code: a twelfth of the squared width of a code in light.
double RoundingVariance(int code) {
  const double width =
      (LightOfCodes()[static_cast<std::size_t>(code + 1)] - LightOfCodes()[static_cast<std::size_t>(code - 1)]) / 2;
  return width * width / 12;
}

// The photon transfer curve (Janesick): variance against mean over flat fields. Its slope is the light per electron,
// and its intercept is the variance of the read-out noise.
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
