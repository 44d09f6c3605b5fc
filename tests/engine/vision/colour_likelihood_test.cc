
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "engine/vision/change_detection.h"
#include "engine/vision/person_finder.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr int kRoomWidth = 120, kRoomHeight = 64, kPoster = 50;
constexpr int kPersonWidth = 18, kHeadTop = 8, kWaist = 30, kFeet = 56;
constexpr Rgb8 kPosterColour = {60, 90, 160}, kWallColour = {150, 120, 90}, kTrousers = {40, 140, 60};
constexpr Rgb8 kShirtColour = {112, 90, 68};  // the wall's hue at three quarters of its light
constexpr Rgb8 kShadow = {84, 67, 50};        // the wall's colour in shadow

/// A room with a poster and a wall, and a person who walks past both; the noise is uniform, up to two levels.
class WalkPast {
 public:
  ColourImage Room() {
    ColourImage room(kRoomWidth, kRoomHeight);
    for (int y = 0; y < kRoomHeight; ++y) {
      for (int x = 0; x < kRoomWidth; ++x) room.At(x, y) = x < kPoster ? kPosterColour : kWallColour;
    }
    return room;
  }
  static bool IsPerson(int left, int x, int y) {
    return x >= left && x < left + kPersonWidth && y >= kHeadTop && y < kFeet;
  }
  /// Draws the person; a shadow lies on the wall at the right, and the lamp gives `light`.
  ColourImage Picture(int left, double light) {
    ColourImage picture = Room();
    for (int y = 0; y < kRoomHeight; ++y) {
      for (int x = 0; x < kRoomWidth; ++x) {
        Rgb8& pixel = picture.At(x, y);
        if (x >= kRoomWidth - 8) pixel = kShadow;
        if (IsPerson(left, x, y)) pixel = y < kWaist ? kShirtColour : kTrousers;
        pixel = {Seen(pixel.r, light), Seen(pixel.g, light), Seen(pixel.b, light)};
      }
    }
    return picture;
  }

 private:
  std::uint8_t Seen(int level, double light) {
    return static_cast<std::uint8_t>(std::clamp(level * light + dice_.Uniform(-2, 2), 0.0, 255.0));
  }

  RandomStream dice_{WorldKey{.suite_seed = 1, .scenario = "colour-likelihood", .trial = 0}, "pixels"};
};

struct Wrong {
  int missed = 0, taken = 0;  ///< pixels of the person outside the mask, and pixels of the room in the mask
};

Wrong WrongIn(const Mask& mask, int left) {
  Wrong wrong;
  for (int y = 0; y < kRoomHeight; ++y) {
    for (int x = 0; x < kRoomWidth; ++x) {
      const bool is_person = WalkPast::IsPerson(left, x, y), is_found = mask.At(x, y) != 0;
      wrong.missed += is_person && !is_found;
      wrong.taken += is_found && !is_person;
    }
  }
  return wrong;
}

constexpr int kPersonPixels = kPersonWidth * (kFeet - kHeadTop), kRimPixels = 2 * (kPersonWidth + kFeet - kHeadTop);

TEST(ColourLikelihood, FindsAShirtOfTheWallsHueOnceItWasSeenBeforeAnotherColour) {
  WalkPast walk;
  PersonFinder finder(walk.Room(), {.segmenter = Segmenter::kLikelihood, .change = {}});
  PersonFinder gated(walk.Room(), {.segmenter = Segmenter::kHueGated, .change = {}});
  for (int left = 4; left <= 80; left += 2) {
    const ColourImage picture = walk.Picture(left, 1 + 0.002 * (left % 20));
    const Wrong found = WrongIn(finder.Find(picture), left), by_hue = WrongIn(gated.Find(picture), left);
    EXPECT_LE(found.taken, kRimPixels / 4) << left << ": shadow, drifting lamp";
    if (left < kPoster) continue;
    EXPECT_LE(found.missed, kRimPixels / 2) << left;
    EXPECT_GE(by_hue.missed, kPersonPixels / 3) << left << ": the control, hues alone, loses the shirt";
  }
}

TEST(ColourLikelihood, DoesNotFindWhatItNeverSawBeforeAnotherColour) {
  WalkPast walk;
  PersonFinder finder(walk.Room(), {.segmenter = Segmenter::kLikelihood, .change = {}});
  for (int left = kPoster; left <= 80; left += 2) {
    const Wrong wrong = WrongIn(finder.Find(walk.Picture(left, 1)), left);
    EXPECT_GE(wrong.missed, kPersonPixels / 4) << left << ": a shadow of that colour would look the same";
    EXPECT_LE(wrong.taken, kRimPixels / 4) << left;
  }
}

TEST(ColourLikelihood, FindsNobodyInTheEmptyRoom) {
  WalkPast walk;
  PersonFinder finder(walk.Room(), {.segmenter = Segmenter::kLikelihood, .change = {}});
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(std::ranges::count(finder.Find(walk.Picture(-kPersonWidth, 1 + 0.01 * k)).pixels, 1), 0) << k;
  }
}

}  // namespace
}  // namespace etude
