#include "engine/vision/person_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/base/angles.h"
#include "engine/vision/change_detection.h"
#include "engine/vision/components.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

RandomStream Dice(int seed) {
  return RandomStream(WorldKey{.suite_seed = 1, .scenario = "person-finder", .trial = seed}, "pixels");
}

/// Returns a picture of any colours, including grey and nearly grey ones, with hues at every distance.
ColourImage AnyPicture(int width, int height, int seed) {
  RandomStream dice = Dice(seed);
  ColourImage picture(width, height);
  const auto level = [&] { return static_cast<std::uint8_t>(dice.Uniform(0, 256)); };
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const std::uint8_t grey = level();
    if (i % 5 == 0) {
      picture.pixels[i] = {grey, grey, grey};
    } else if (i % 5 == 1) {
      picture.pixels[i] = {grey, static_cast<std::uint8_t>(grey / 2), static_cast<std::uint8_t>(grey / 3)};
    } else {
      picture.pixels[i] = {level(), level(), level()};
    }
  }
  return picture;
}

TEST(PersonFinder, FindsTheSamePixelsAsExtractPerson) {
  for (const Segmenter segmenter : {Segmenter::kRgb, Segmenter::kHue, Segmenter::kHueGated, Segmenter::kRatio}) {
    for (int seed = 0; seed < 10; ++seed) {
      const ColourImage background = AnyPicture(97, 61, 2 * seed), picture = AnyPicture(97, 61, 2 * seed + 1);
      PersonOptions options{.segmenter = segmenter, .change = {}};
      options.change.hue_threshold = Radians(3 + 8 * seed);
      PersonFinder finder(background, options);
      EXPECT_EQ(finder.Detect(picture).pixels, DetectChange(background, picture, segmenter, options.change).pixels);
      EXPECT_EQ(finder.Find(picture).pixels, ExtractPerson(background, picture, options).pixels);
      EXPECT_EQ(finder.Find(background).pixels, ExtractPerson(background, background, options).pixels);
    }
  }
}

TEST(KeepPerson, IsTheLargestPieceWithItsSmallHolesFilled) {
  for (int seed = 0; seed < 40; ++seed) {
    RandomStream dice = Dice(1000 + seed);
    Mask mask(37, 23);
    // The share ranges from scattered pixels to a sheet with holes.
    const double share = 0.05 + 0.023 * seed;
    for (std::uint8_t& pixel : mask.pixels) pixel = dice.Uniform(0, 1) < share ? 1 : 0;
    for (const int max_hole_px : {0, 1, 5, 1000}) {
      Mask kept = mask;
      KeepPerson(kept, max_hole_px);
      EXPECT_EQ(kept.pixels, FillHoles(LargestComponent(mask), max_hole_px).pixels) << seed << ", " << max_hole_px;
    }
  }
  Mask nothing(5, 4);
  KeepPerson(nothing, 60);
  EXPECT_EQ(std::ranges::count(nothing.pixels, 1), 0);
}

/// Hues exactly at the threshold: what single precision cannot decide is computed again in double precision.
TEST(PersonFinder, AgreesWhereHuesAreAsFarApartAsTheThreshold) {
  const ColourImage background = AnyPicture(64, 64, 1), picture = AnyPicture(64, 64, 2);
  int compared = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const Chroma a(background.pixels[i]), b(picture.pixels[i]);
    const double dot = Dot4(a, b);
    if (a.IsGrey() || b.IsGrey() || dot <= 0) continue;
    const double cosine = dot / std::sqrt(static_cast<double>(Dot4(a, a)) * Dot4(b, b));
    PersonOptions options{.segmenter = Segmenter::kHue, .change = {}};
    options.change.hue_threshold = std::acos(std::min(1.0, cosine));
    PersonFinder finder(background, options);
    EXPECT_EQ(finder.Detect(picture).pixels, DetectChange(background, picture, Segmenter::kHue, options.change).pixels);
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

bool IsFound(Rgb8 background, Rgb8 pixel, Segmenter segmenter) {
  return DetectChange(ColourImage(1, 1, background), ColourImage(1, 1, pixel), segmenter).pixels[0] != 0;
}

TEST(Segmenters, RgbTakesAShadowForAPersonAndRatioDoesNot) {
  const Rgb8 wall{160, 120, 90}, shadow{96, 72, 54}, lit{184, 138, 104}, shirt{90, 120, 160}, black{20, 15, 11};
  EXPECT_TRUE(IsFound(wall, shadow, Segmenter::kRgb));
  EXPECT_FALSE(IsFound(wall, shadow, Segmenter::kRatio));
  EXPECT_FALSE(IsFound(wall, lit, Segmenter::kRatio));
  for (const Segmenter segmenter : {Segmenter::kRgb, Segmenter::kRatio}) {
    EXPECT_TRUE(IsFound(wall, shirt, segmenter)) << "the control: another colour of the same sum";
    EXPECT_TRUE(IsFound(wall, black, segmenter)) << "darker than any shadow";
    EXPECT_FALSE(IsFound(wall, {162, 118, 91}, segmenter)) << "noise";
  }
}

TEST(Segmenters, RgbComparesTheMostDifferentColour) {
  const ChangeOptions options;
  const auto moved = [&](int by) { return Rgb8{100, static_cast<std::uint8_t>(100 + by), 100}; };
  EXPECT_FALSE(IsFound({100, 100, 100}, moved(options.rgb_threshold), Segmenter::kRgb));
  EXPECT_TRUE(IsFound({100, 100, 100}, moved(options.rgb_threshold + 1), Segmenter::kRgb));
}

/// A bright square that moves over a noisy grey wall, after `first` frames of the wall alone.
class Film {
 public:
  ColourImage Next(bool has_square) {
    ColourImage picture(60, 40);
    for (Rgb8& pixel : picture.pixels) {
      const auto level = static_cast<std::uint8_t>(100 + 2 * dice_.Normal() + 0.5);
      pixel = {level, level, level};
    }
    for (int y = 10; y < 30 && has_square; ++y) {
      for (int x = 0; x < 12; ++x) picture.At(4 + frame_ % 40 + x, y) = {220, 60, 60};
    }
    frame_ += has_square ? 1 : 0;
    return picture;
  }
  bool IsSquare(int x, int y) const {
    const int left = 4 + (frame_ - 1) % 40;
    return y >= 10 && y < 30 && x >= left && x < left + 12;
  }

 private:
  RandomStream dice_ = Dice(77);
  int frame_ = 0;
};

TEST(RunningBackground, LearnsTheRoomAndThenSeesWhoComesIn) {
  Film film;
  PersonFinder finder(ColourImage(60, 40), {.segmenter = Segmenter::kRunning, .change = {}});
  for (int k = 0; k < 30; ++k) finder.Find(film.Next(false));
  int wrong = 0, square = 0;
  for (int k = 0; k < 20; ++k) {
    const Mask mask = finder.Find(film.Next(true));
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 60; ++x) {
        wrong += (mask.At(x, y) != 0) != film.IsSquare(x, y);
        square += film.IsSquare(x, y);
      }
    }
  }
  EXPECT_GT(square, 0);
  EXPECT_LT(wrong, square / 50);
}

TEST(RunningBackground, LeavesAGhostWhereSomebodyStoodInTheFirstPictureAndForgetsIt) {
  ColourImage with(20, 10, {100, 100, 100}), without(20, 10, {100, 100, 100});
  for (int x = 5; x < 10; ++x) with.At(x, 5) = {220, 60, 60};
  PersonFinder finder(with, {.segmenter = Segmenter::kRunning, .change = {}});
  EXPECT_EQ(std::ranges::count(finder.Detect(with).pixels, 1), 0) << "the first picture is the background";
  EXPECT_EQ(std::ranges::count(finder.Detect(without).pixels, 1), 5) << "a ghost";
  for (int k = 0; k < 2000; ++k) finder.Detect(without);
  EXPECT_EQ(std::ranges::count(finder.Detect(without).pixels, 1), 0);
  EXPECT_EQ(std::ranges::count(finder.Detect(with).pixels, 1), 5) << "the control: it has learnt the room";
}

}  // namespace
}  // namespace etude
