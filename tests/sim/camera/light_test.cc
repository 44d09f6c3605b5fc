#include "sim/camera/light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

TEST(Light, GivesEveryCodeBack) {
  for (int code = 0; code < 256; ++code) {
    ASSERT_EQ(CodeTable::Get()(LightOfCodes()[static_cast<std::size_t>(code)]), code);
  }
}

// Returns the code by IEC 61966-2-1, a second implementation.
double ExactCode(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

TEST(Light, IsEncodedWithinASmallPartOfACount) {
  double worst = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const double light = i / 1e6;
    worst = std::max(worst, std::abs(CodeTable::Get()(static_cast<float>(light)) - ExactCode(light)));
  }
  EXPECT_LE(worst, 0.5 + 0.11);
  EXPECT_GT(worst, 0.5) << "a table that were exact would need no tolerance";
}

TEST(Light, OutsideOfWhatAPictureHoldsIsCutOff) {
  EXPECT_EQ(CodeTable::Get()(-0.3f), 0);
  EXPECT_EQ(CodeTable::Get()(1.7f), 255);
  EXPECT_EQ(CodeTable::Get()(std::nanf("")), 0);
}

TEST(Light, RowsAreDecodedAndEncodedPixelByPixel) {
  const Rgb8 row[] = {{1, 2, 3}, {200, 100, 0}, {255, 254, 128}};
  Light light[3], sum[3];
  DecodeRow(row, 3, light);
  AddDecodedRow(row, 3, 0.25f, sum);
  Rgb8 back[3];
  EncodeRow(light, 3, back);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(back[i], row[i]);
    EXPECT_FLOAT_EQ(sum[i].g, 0.25f * light[i].g);
  }
}

}  // namespace
}  // namespace etude
