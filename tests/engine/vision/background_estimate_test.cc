#include "engine/vision/background_estimate.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

constexpr int kWidth = 90, kHeight = 40, kPictures = 20, kBox = 30;

Rgb8 RoomAt(int x, int y) {
  return {static_cast<std::uint8_t>(40 + 7 * x % 90), static_cast<std::uint8_t>(60 + 11 * y % 70), 90};
}

/// Returns a picture of a striped box, as high as the picture. It enters from the left, stands in the middle most of
/// the time, and leaves to the right.
ColourImage PictureOf(int k) {
  const int left = k < 4 ? 10 * k - 10 : k < 16 ? 30 + k % 3 : 30 + 10 * (k - 15);
  ColourImage picture(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool is_box = x >= left && x < left + kBox;
      picture.At(x, y) =
          is_box ? Rgb8{static_cast<std::uint8_t>((x - left) / 2 % 2 ? 240 : 200), 30, 30} : RoomAt(x, y);
    }
  }
  return picture;
}

std::vector<ColourImage> Pictures() {
  std::vector<ColourImage> pictures;
  for (int k = 0; k < kPictures; ++k) pictures.push_back(PictureOf(k));
  return pictures;
}

int PixelsUnlikeRoom(const ColourImage& background) {
  int unlike = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) unlike += !(background.At(x, y) == RoomAt(x, y));
  }
  return unlike;
}

TEST(EstimateBackground, ShowsTheRoomBehindSomebodyWhoHidesItMostly) {
  const std::vector<ColourImage> pictures = Pictures();
  const std::vector<Activity> motion = MotionActivity(pictures, {.lag = 1, .reach = 4, .change = 14});
  EXPECT_EQ(PixelsUnlikeRoom(EstimateBackground(pictures, motion, 3)), 0);
  EXPECT_GT(PixelsUnlikeRoom(EstimateBackground(pictures, motion, kPictures)), kBox * kHeight / 2)
      << "the control: a median over all shows the box";
}

TEST(EstimateBackground, TakesTheCalmestPicturesAndOfEqualsTheEarliest) {
  std::vector<ColourImage> pictures;
  std::vector<Activity> activity;
  for (int k = 0; k < 5; ++k) {
    pictures.emplace_back(1, 1, Rgb8{static_cast<std::uint8_t>(10 * k), 0, static_cast<std::uint8_t>(100 - 10 * k)});
    activity.emplace_back(1, 1, k == 1 ? 0.0f : 1.0f);
  }
  EXPECT_EQ(EstimateBackground(pictures, activity, 1).At(0, 0), (Rgb8{10, 0, 90}));
  EXPECT_EQ(EstimateBackground(pictures, activity, 3).At(0, 0), (Rgb8{10, 0, 90}))
      << "0, 10 and 20: the median of each colour";
  EXPECT_EQ(EstimateBackground(pictures, activity, 9).At(0, 0), (Rgb8{20, 0, 80})) << "all, where more are asked for";
}

TEST(MotionActivity, IsTheShareOfPixelsAboutThatChange) {
  std::vector<ColourImage> pictures(3, ColourImage(9, 9, Rgb8{50, 50, 50}));
  pictures[2].At(4, 4) = {80, 50, 50};
  const std::vector<Activity> motion = MotionActivity(pictures, {.lag = 1, .reach = 1, .change = 14});
  EXPECT_FLOAT_EQ(motion[0].At(4, 4), 0);
  EXPECT_FLOAT_EQ(motion[1].At(5, 3), 1.0f / 9);
  EXPECT_FLOAT_EQ(motion[1].At(6, 4), 0);
  EXPECT_FLOAT_EQ(motion[2].At(4, 4), 1.0f / 9);
  EXPECT_FLOAT_EQ(MotionActivity(pictures, {.lag = 1, .reach = 4, .change = 14})[1].At(0, 0), 1.0f / 25)
      << "of what lies in the picture";
  EXPECT_FLOAT_EQ(MotionActivity(pictures, {.lag = 1, .reach = 1, .change = 40})[1].At(4, 4), 0);
}

}  // namespace
}  // namespace etude
