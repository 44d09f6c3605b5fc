#include "engine/base/image.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

TEST(Srgb, EveryValueComesBack) {
  for (int value = 0; value < 256; ++value) {
    EXPECT_EQ(SrgbOfLinear(LinearOfSrgb(static_cast<std::uint8_t>(value))), value);
  }
}

TEST(Srgb, IsTheStandardsCurve) {
  EXPECT_EQ(LinearOfSrgb(0), 0);
  EXPECT_EQ(LinearOfSrgb(255), 1);
  EXPECT_NEAR(LinearOfSrgb(10), 10 / 255.0 / 12.92, 1e-15) << "the straight part";
  EXPECT_NEAR(LinearOfSrgb(188), 0.5029, 1e-4) << "half the light is three quarters of the value";
}

TEST(Srgb, LightBeyondTheScreensIsClamped) {
  EXPECT_EQ(SrgbOfLinear(-0.1), 0);
  EXPECT_EQ(SrgbOfLinear(7), 255);
}

TEST(Image, ContainsItsPixelsAndNoneBeyond) {
  ColourImage image(3, 2, {1, 2, 3});
  for (int y = -1; y <= 2; ++y) {
    for (int x = -1; x <= 3; ++x) EXPECT_EQ(image.Contains(x, y), x >= 0 && x < 3 && y >= 0 && y < 2) << x << ", " << y;
  }
  image.At(2, 1).g = 9;
  EXPECT_EQ(image.pixels[5].g, 9) << "row after row";
}

}  // namespace
}  // namespace etude
