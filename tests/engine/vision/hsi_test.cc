#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "engine/vision/change_detection.h"

namespace etude {
namespace {

TEST(Hsi, HasTheKnownHuesOfThePureColours) {
  EXPECT_NEAR(Degrees(ToHsi({255, 0, 0}).hue), 0, 1e-6);
  EXPECT_NEAR(Degrees(ToHsi({255, 255, 0}).hue), 60, 1e-6);
  EXPECT_NEAR(Degrees(ToHsi({0, 255, 0}).hue), 120, 1e-6);
  EXPECT_NEAR(Degrees(ToHsi({0, 255, 255}).hue), 180, 1e-5);
  EXPECT_NEAR(Degrees(ToHsi({0, 0, 255}).hue), 240, 1e-6);
  EXPECT_NEAR(Degrees(ToHsi({255, 0, 255}).hue), 300, 1e-6);
}

TEST(Hsi, GivesTheWorkedExampleOfTheFormulas) {
  // R = 100, G = 150, B = 200: θ = arccos(−75 / √7500) = 150°, B > G, so H = 210°.
  const Hsi hsi = ToHsi({100, 150, 200});
  EXPECT_NEAR(Degrees(hsi.hue), 210, 1e-9);
  EXPECT_NEAR(hsi.saturation, 1 - 3 * 100.0 / 450, 1e-12);
  EXPECT_NEAR(hsi.intensity, 150, 1e-12);
}

TEST(Hsi, IsDefinedForGreyAndBlack) {
  for (std::uint8_t level : {0, 1, 128, 255}) {
    const Hsi hsi = ToHsi({level, level, level});
    EXPECT_EQ(hsi.hue, 0);
    EXPECT_NEAR(hsi.saturation, 0, 1e-12);
    EXPECT_EQ(hsi.intensity, level);
  }
}

TEST(Hsi, KeepsHueAndSaturationWhenTheLightHalves) {
  const Hsi bright = ToHsi({200, 120, 40}), dim = ToHsi({100, 60, 20});
  EXPECT_NEAR(bright.hue, dim.hue, 1e-12);
  EXPECT_NEAR(bright.saturation, dim.saturation, 1e-12);
  EXPECT_NEAR(bright.intensity, 2 * dim.intensity, 1e-12);
}

TEST(Chroma, HasTheHueAsItsPolarAngleForEveryColour) {
  int checked = 0;
  for (int r = 0; r < 256; r += 5) {
    for (int g = 0; g < 256; g += 5) {
      for (int b = 0; b < 256; b += 5) {
        const Rgb8 colour{static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)};
        const Chroma chroma(colour);
        if (chroma.IsGrey()) continue;
        const double angle = std::atan2(std::sqrt(3.0) * chroma.y, chroma.x);
        const double difference = std::remainder(angle - ToHsi(colour).hue, 2 * kPi);
        ASSERT_NEAR(difference, 0, 1e-6) << r << ' ' << g << ' ' << b;  // arccos has only this accuracy near 0 and π
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100000);
}

TEST(Chroma, HasTheCosineOfTheHuesAngleAsItsDotProduct) {
  const Rgb8 a{200, 120, 40}, b{30, 90, 160};
  const double cosine =
      Dot4(Chroma(a), Chroma(b)) / std::sqrt(1.0 * Dot4(Chroma(a), Chroma(a)) * Dot4(Chroma(b), Chroma(b)));
  EXPECT_NEAR(cosine, std::cos(ToHsi(a).hue - ToHsi(b).hue), 1e-12);
}

}  // namespace
}  // namespace etude
