#include "bench/metrics/segmentation.h"

#include <gtest/gtest.h>

#include <vector>

namespace etude {
namespace {

Mask Row(std::vector<std::uint8_t> pixels) {
  Mask mask(static_cast<int>(pixels.size()), 1);
  mask.pixels = std::move(pixels);
  return mask;
}

TEST(MaskScore, HasTheValuesCountedByHand) {
  // found 4, true 5, both 3, either 6; 1 of 2 shadow pixels found.
  const MaskScore score =
      ScoreMask(Row({1, 1, 1, 0, 0, 1, 0, 0}), Row({1, 1, 1, 1, 1, 0, 0, 0}), Row({0, 0, 0, 0, 0, 1, 1, 0}));
  EXPECT_DOUBLE_EQ(*score.iou, 3.0 / 6);
  EXPECT_DOUBLE_EQ(*score.precision, 3.0 / 4);
  EXPECT_DOUBLE_EQ(*score.recall, 3.0 / 5);
  EXPECT_DOUBLE_EQ(*score.f1, 2 * 0.75 * 0.6 / (0.75 + 0.6));
  EXPECT_DOUBLE_EQ(*score.shadow_error, 0.5);
  EXPECT_DOUBLE_EQ(*score.pwc, 100.0 * 3 / 8);
}

TEST(MaskScore, IsOneForThePerfectMaskAndNotForAnyOther) {
  const Mask truth = Row({0, 1, 1, 0}), nothing = Row({0, 0, 0, 0});
  EXPECT_EQ(*ScoreMask(truth, truth, nothing).iou, 1);
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    Mask other = truth;
    other.pixels[i] = !other.pixels[i];
    EXPECT_LT(*ScoreMask(other, truth, nothing).iou, 1) << i;
    EXPECT_LT(*ScoreMask(other, truth, nothing).f1, 1) << i;
  }
}

TEST(MaskScore, IsMissingWhereThereIsNothingToBeAShareOf) {
  const Mask nothing = Row({0, 0}), truth = Row({1, 0});
  const MaskScore empty = ScoreMask(nothing, nothing, nothing);
  EXPECT_FALSE(empty.iou || empty.precision || empty.recall || empty.f1 || empty.shadow_error);
  EXPECT_EQ(*empty.pwc, 0) << "an empty room counts";
  const MaskScore missed = ScoreMask(nothing, truth, nothing);
  EXPECT_EQ(*missed.iou, 0);
  EXPECT_EQ(*missed.recall, 0);
  EXPECT_FALSE(missed.precision);
}

TEST(MeanScore, LeavesOutImagesWithoutAValue) {
  const std::vector<MaskScore> scores = {{.iou = 0.5}, {.iou = 1.0, .recall = 0.25}, {}};
  const MaskScore mean = MeanScore(scores);
  EXPECT_DOUBLE_EQ(*mean.iou, 0.75);
  EXPECT_DOUBLE_EQ(*mean.recall, 0.25);
  EXPECT_FALSE(mean.precision);
}

}  // namespace
}  // namespace etude
