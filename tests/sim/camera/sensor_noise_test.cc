#include <gtest/gtest.h>

#include <cmath>

#include "sim/sensors/camera_sensor.h"

namespace etude {
namespace {

constexpr WorldKey kWorld{7, "camera-sensor", 0};

struct Statistics {
  double mean = 0;
  double deviation = 0;
};

template <typename Channel>
Statistics Measure(const ColourImage& image, Channel channel) {
  double sum = 0, squares = 0;
  for (const Rgb8& pixel : image.pixels) {
    sum += channel(pixel);
    squares += double{1} * channel(pixel) * channel(pixel);
  }
  const double count = static_cast<double>(image.pixels.size());
  return {sum / count, std::sqrt(squares / count - sum * sum / count / count)};
}

ColourImage Disturb(Rgb8 colour, const CameraNoise& options) {
  RandomStream random(kWorld, "noise");
  return AddCameraNoise(ColourImage(400, 300, colour), options, random);
}

TEST(CameraSensor, HasTheVarianceOfReadingPlusPhotons) {
  const CameraNoise options{.read_noise = 2, .photon_noise = 3};
  const ColourImage noisy = Disturb({40, 128, 220}, options);
  // Rounding to whole counts adds 1/12. The sample's own error is 0.2 % of the deviation.
  const auto expected = [](double value) { return std::sqrt(4 + 9 * value / 255 + 1.0 / 12); };
  const Statistics red = Measure(noisy, [](Rgb8 p) { return p.r; });
  const Statistics green = Measure(noisy, [](Rgb8 p) { return p.g; });
  const Statistics blue = Measure(noisy, [](Rgb8 p) { return p.b; });
  EXPECT_NEAR(red.mean, 40, 0.03);
  EXPECT_NEAR(green.mean, 128, 0.03);
  EXPECT_NEAR(blue.mean, 220, 0.04);
  EXPECT_NEAR(red.deviation, expected(40), 0.02);
  EXPECT_NEAR(green.deviation, expected(128), 0.03);
  EXPECT_NEAR(blue.deviation, expected(220), 0.03);
  EXPECT_GT(std::abs(red.deviation - expected(220)), 0.3) << "the tolerance tells dark from light";
}

TEST(CameraSensor, IsIndependentBetweenChannelsAndNeighbours) {
  const ColourImage noisy = Disturb({128, 128, 128}, {.read_noise = 4, .photon_noise = 0});
  double channels = 0, neighbours = 0, self = 0;
  for (std::size_t i = 0; i + 1 < noisy.pixels.size(); ++i) {
    const double red = noisy.pixels[i].r - 128.0, green = noisy.pixels[i].g - 128.0;
    channels += red * green;
    neighbours += red * (noisy.pixels[i + 1].r - 128.0);
    self += red * red;
  }
  EXPECT_LT(std::abs(channels / self), 0.015);
  EXPECT_LT(std::abs(neighbours / self), 0.015);
}

TEST(CameraSensor, HasTheTailsOfANormalDistribution) {
  const ColourImage noisy = Disturb({128, 128, 128}, {.read_noise = 20, .photon_noise = 0});
  int beyond_two = 0, beyond_three = 0;
  for (const Rgb8& pixel : noisy.pixels) {
    const double off = std::abs(pixel.g - 128.0);
    beyond_two += off > 40.5;
    beyond_three += off > 60.5;
  }
  const double count = static_cast<double>(noisy.pixels.size());
  EXPECT_NEAR(beyond_two / count, std::erfc(2.025 / std::sqrt(2.0)), 0.002);
  EXPECT_NEAR(beyond_three / count, std::erfc(3.025 / std::sqrt(2.0)), 0.0006);
}

TEST(CameraSensor, WithoutNoiseKeepsThePicture) {
  const ColourImage image = Disturb({0, 100, 255}, {.read_noise = 0, .photon_noise = 0});
  for (const Rgb8& pixel : image.pixels) ASSERT_EQ(pixel, (Rgb8{0, 100, 255}));
}

TEST(CameraSensor, ExposureScalesTheWholeFrameByOneDraw) {
  const CameraNoise options{.read_noise = 0, .photon_noise = 0, .exposure_deviation = 0.1};
  RandomStream random(kWorld, "noise");
  const double gain = 1 + 0.1 * random.Normal();
  ASSERT_GT(std::abs(gain - 1), 0.005);
  for (const Rgb8& pixel : Disturb({50, 100, 150}, options).pixels) {
    ASSERT_NEAR(pixel.g, 100 * gain, 0.51);
    ASSERT_NEAR(pixel.b, 150 * gain, 0.51);
  }
}

TEST(CameraSensor, DrawsAsOftenWhateverTheStrengths) {
  RandomStream weak(kWorld, "noise"), strong(kWorld, "noise");
  AddCameraNoise(ColourImage(31, 17), {.read_noise = 0, .photon_noise = 0}, weak);
  AddCameraNoise(ColourImage(31, 17), {.read_noise = 9, .photon_noise = 9, .exposure_deviation = 0.2}, strong);
  EXPECT_EQ(weak.Bits(), strong.Bits());
}

}  // namespace
}  // namespace etude
