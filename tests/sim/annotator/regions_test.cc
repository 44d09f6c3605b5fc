#include "sim/annotator/regions.h"

#include <gtest/gtest.h>

#include "tests/sim/annotator/annotated_body.h"

namespace etude {
namespace {

constexpr auto kThigh = static_cast<std::uint32_t>(Part::kLeftThigh);
constexpr auto kShank = static_cast<std::uint32_t>(Part::kLeftShank);
constexpr std::uint32_t kChair = 16;

// A thigh of 10 × 4 pixels above a shank of 10 × 6; a bystander's leg beside them.
LabelImage Leg() {
  LabelImage labels(30, 20);
  for (int y = 2; y < 12; ++y) {
    for (int x = 5; x < 15; ++x) labels.At(x, y) = y < 6 ? kThigh : kShank;
    for (int x = 18; x < 20; ++x) labels.At(x, y) = kChair;
  }
  return labels;
}

TEST(FindRegions, CountsEachPartsPixelsAndTheirMiddle) {
  const Shown shown(Leg());
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  EXPECT_EQ(regions[Part::kLeftThigh].pixels, 40);
  EXPECT_EQ(regions[Part::kLeftShank].pixels, 60);
  EXPECT_EQ(regions[Part::kLeftThigh].middle, glm::dvec2(10, 4));
  EXPECT_EQ(regions[Part::kLeftShank].middle, glm::dvec2(10, 9));
  int all = 0;
  for (const Region& region : regions.parts) all += region.pixels;
  EXPECT_EQ(all, 100) << "furniture and other people are no part of the performer";
}

TEST(FindRegions, FindsTheCommonBorderOfNeighboursInTheBody) {
  const Shown shown(Leg());
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  const auto& knee = regions.borders[StrokeTo(Role::kLeftAnkle)];
  ASSERT_EQ(knee.size(), 10u);
  for (std::size_t i = 0; i < knee.size(); ++i) EXPECT_EQ(knee[i], glm::dvec2(5.5 + static_cast<double>(i), 6));
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (i == StrokeTo(Role::kLeftAnkle)) continue;
    EXPECT_TRUE(regions.borders[i].empty());
  }
}

TEST(FindRegions, SeesNothingThatTheSegmenterLostButForTheMargin) {
  Shown shown(Leg());
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) shown.person.At(x, y) = x < 8;
  }
  EXPECT_EQ(FindRegions(shown.labels, shown.colours, shown.person, 0)[Part::kLeftShank].pixels, 3 * 6);
  EXPECT_EQ(FindRegions(shown.labels, shown.colours, shown.person, 2)[Part::kLeftShank].pixels, 5 * 6);
  shown.person = Mask(30, 20);
  for (const Region& region : FindRegions(shown.labels, shown.colours, shown.person, 3).parts) {
    EXPECT_EQ(region.pixels, 0);
  }
}

TEST(FindRegions, MeasuresContrastAcrossTheOutlineAndNotTowardsTheNextLimb) {
  Shown shown(Leg());
  for (auto& pixel : shown.colours.pixels) pixel = {50, 60, 70};
  for (int y = 2; y < 12; ++y) {
    for (int x = 5; x < 15; ++x) shown.colours.At(x, y) = {53, 64, 70};
  }
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  EXPECT_DOUBLE_EQ(regions[Part::kLeftThigh].contrast, 5);  // √(3² + 4²)
  EXPECT_DOUBLE_EQ(regions[Part::kLeftShank].contrast, 5);
}

}  // namespace
}  // namespace etude
