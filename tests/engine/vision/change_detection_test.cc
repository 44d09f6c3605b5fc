#include "engine/vision/change_detection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/vision/hsi.h"

namespace etude {
namespace {

constexpr Rgb8 kWall{170, 140, 100};
constexpr Rgb8 kShirt{40, 60, 160};
constexpr Rgb8 kGreyWall{120, 120, 120};

bool Differs(Rgb8 background, Rgb8 pixel, Segmenter segmenter) {
  return DetectChange(ColourImage(1, 1, background), ColourImage(1, 1, pixel), segmenter).pixels[0] != 0;
}

Rgb8 Scaled(Rgb8 c, double light) {
  auto scale = [&](int level) { return static_cast<std::uint8_t>(std::min(255.0, std::round(level * light))); };
  return {scale(c.r), scale(c.g), scale(c.b)};
}

TEST(DetectChange, SeesAnotherHueAndNotAShadow) {
  for (Segmenter segmenter : {Segmenter::kHue, Segmenter::kHueGated}) {
    EXPECT_TRUE(Differs(kWall, kShirt, segmenter));
    EXPECT_FALSE(Differs(kWall, kWall, segmenter));
    EXPECT_FALSE(Differs(kWall, Scaled(kWall, 0.6), segmenter));
    EXPECT_FALSE(Differs(kWall, Scaled(kWall, 1.15), segmenter));
  }
}

TEST(DetectChange, AgreesWithTheArcCosineFormula) {
  const ChangeOptions options;
  int checked = 0;
  for (int i = 0; i < 20000; ++i) {
    auto level = [&](int k) { return static_cast<std::uint8_t>((i * 7919 + k * 104729 + i * k * 31) % 256); };
    const Rgb8 a{level(1), level(2), level(3)}, b{level(4), level(5), level(6)};
    const double apart = std::abs(std::remainder(ToHsi(a).hue - ToHsi(b).hue, 2 * kPi));
    if (std::abs(apart - options.hue_threshold) < 1e-6) continue;
    ASSERT_EQ(Differs(a, b, Segmenter::kHue), apart > options.hue_threshold) << i;
    ++checked;
  }
  EXPECT_GT(checked, 19000);
}

TEST(DetectChange, ComparesHuesRoundTheCircle) {
  // Hues of about 355° and 5°: ten degrees apart, not 350.
  EXPECT_FALSE(Differs({200, 40, 53}, {200, 53, 40}, Segmenter::kHue));
}

TEST(DetectChange, TakesGreyForRedAsThePaperDoesUnlessGated) {
  // Two nearly grey pixels that noise pushed to opposite hues.
  EXPECT_TRUE(Differs({121, 120, 120}, {120, 121, 121}, Segmenter::kHue));
  EXPECT_FALSE(Differs({121, 120, 120}, {120, 121, 121}, Segmenter::kHueGated));
}

TEST(DetectChange, FallsBackToLightWhereBothAreGrey) {
  EXPECT_FALSE(Differs(kGreyWall, Scaled(kGreyWall, 0.6), Segmenter::kHueGated)) << "a shadow";
  EXPECT_TRUE(Differs(kGreyWall, Scaled(kGreyWall, 0.2), Segmenter::kHueGated)) << "black trousers";
  EXPECT_TRUE(Differs(kGreyWall, Scaled(kGreyWall, 1.8), Segmenter::kHueGated)) << "a white shirt";
}

TEST(DetectChange, SeesDarkTrousersOfTheFloorsHueOnlyWhenGated) {
  const Rgb8 floor{90, 110, 180}, trousers{31, 39, 66};
  EXPECT_FALSE(Differs(floor, trousers, Segmenter::kHue));
  EXPECT_TRUE(Differs(floor, trousers, Segmenter::kHueGated));
}

TEST(DetectChange, SeesAColourBeforeGreyAndGreyBeforeAColour) {
  EXPECT_TRUE(Differs(kGreyWall, kShirt, Segmenter::kHueGated));
  EXPECT_TRUE(Differs(kShirt, kGreyWall, Segmenter::kHueGated));
}

TEST(ExtractPerson, KeepsThePersonWithoutSpecksAndHolesAndLeavesTheGapAtTheArm) {
  const ColourImage background(60, 60, kWall);
  ColourImage picture = background;
  Mask expected(60, 60);
  for (int y = 10; y < 50; ++y) {
    for (int x = 10; x < 40; ++x) {
      const bool gap = x >= 14 && x < 20 && y >= 20 && y < 40;  // 120 pixels
      if (gap) continue;
      picture.At(x, y) = kShirt;
      expected.At(x, y) = 1;
    }
  }
  picture.At(30, 30) = picture.At(31, 30) = kWall;  // a hole of noise
  picture.At(55, 5) = kShirt;                       // a speck
  const PersonOptions options;
  EXPECT_EQ(ExtractPerson(background, picture, options).pixels, expected.pixels);
}

TEST(ExtractPerson, FindsNobodyInAnEmptyRoom) {
  const ColourImage background(20, 20, kWall);
  const Mask person = ExtractPerson(background, background, {});
  EXPECT_EQ(std::count(person.pixels.begin(), person.pixels.end(), 1), 0);
}

}  // namespace
}  // namespace etude
