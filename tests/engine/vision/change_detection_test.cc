#include "engine/vision/change_detection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
  // Two nearly grey pixels, to which noise gave opposite hues.
  EXPECT_TRUE(Differs({121, 120, 120}, {120, 121, 121}, Segmenter::kHue));
  EXPECT_FALSE(Differs({121, 120, 120}, {120, 121, 121}, Segmenter::kHueGated));
}

TEST(DetectChange, TrustsNoHueInTheDarkWhenGated) {
  // Opposite hues with saturations of 14 % and 8 %, but only four levels from grey, which noise can cause.
  const Rgb8 reddish{12, 8, 8}, bluish{8, 12, 12};
  EXPECT_TRUE(Differs(reddish, bluish, Segmenter::kHue));
  EXPECT_FALSE(Differs(reddish, bluish, Segmenter::kHueGated));
  const Rgb8 red{80, 8, 8}, blue{8, 50, 50};
  EXPECT_TRUE(Differs(red, blue, Segmenter::kHueGated)) << "the control: equally dark, but far from grey";
}

// A second implementation of the documented rules of `kHueGated`, with hue and saturation by Hsi.
bool DiffersByTheRules(Rgb8 background, Rgb8 pixel, const ChangeOptions& o) {
  struct Tone {
    Hsi hsi;
    bool has_hue;
  };
  auto tone_of = [&](Rgb8 c) {
    const Hsi hsi = ToHsi(c);
    const double r = c.r, g = c.g, b = c.b;
    const double from_grey = std::sqrt(r * r + g * g + b * b - r * g - g * b - b * r);
    return Tone{hsi, hsi.saturation > o.min_saturation && from_grey > o.min_chroma};
  };
  const Tone b = tone_of(background), p = tone_of(pixel);
  if (b.has_hue && p.has_hue && std::abs(std::remainder(b.hsi.hue - p.hsi.hue, 2 * kPi)) > o.hue_threshold) return true;
  if (b.has_hue != p.has_hue && std::abs(b.hsi.saturation - p.hsi.saturation) > o.saturation_threshold) return true;
  return p.hsi.intensity < o.darkest_shadow * b.hsi.intensity || p.hsi.intensity > o.brightest_light * b.hsi.intensity;
}

TEST(DetectChange, FollowsTheRulesOfTheGateForColoursOfEveryKind) {
  // No colour lies exactly at these thresholds, so both computations agree on either side of them.
  const ChangeOptions options{.hue_threshold = Radians(20.123),
                              .min_saturation = 0.10007,
                              .min_chroma = 14.03,
                              .saturation_threshold = 0.18003,
                              .darkest_shadow = 0.45007,
                              .brightest_light = 1.30007};
  int changed = 0, checked = 0;
  for (int i = 0; i < 40000; ++i) {
    // From near black to bright; the second colour is near the first, so intensity alone seldom decides.
    auto noise = [&](int k, int range) { return (i * 7919 + k * 104729 + i * k * 31 + i / 7 * k) % range; };
    auto level = [&](int k) { return std::min(255, noise(4, 180) + noise(k, 60)); };
    const Rgb8 a{static_cast<std::uint8_t>(level(1)), static_cast<std::uint8_t>(level(2)),
                 static_cast<std::uint8_t>(level(3))};
    auto near = [&](int k, std::uint8_t from) {
      return static_cast<std::uint8_t>(std::clamp(from + noise(k, 49) - 24, 0, 255));
    };
    const Rgb8 b{near(5, a.r), near(6, a.g), near(7, a.b)};
    const bool expected = DiffersByTheRules(a, b, options);
    const Mask mask = DetectChange(ColourImage(1, 1, a), ColourImage(1, 1, b), Segmenter::kHueGated, options);
    ASSERT_EQ(mask.pixels[0] != 0, expected) << i;
    changed += expected ? 1 : 0;
    ++checked;
  }
  EXPECT_GT(changed, checked / 10);
  EXPECT_LT(changed, 9 * checked / 10);
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
