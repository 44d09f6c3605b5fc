#include "engine/vision/strokes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace etude {
namespace {

TEST(Strokes, HaveNoTwoEqualColoursAndNoBlackOne) {
  std::vector<Rgb8> palette = {Rgb8{}};
  for (const StrokeMark& mark : StrokeMarks()) {
    palette.push_back(mark.first_half);
    palette.push_back(mark.second_half);
  }
  for (const EffectorMark& mark : EffectorMarks()) palette.push_back(mark.colour);
  ASSERT_EQ(palette.size(), 1 + 2 * kStrokeCount + kEffectorCount);
  for (std::size_t i = 0; i < palette.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(palette[i] == palette[j]) << i << ", " << j;
  }
}

TEST(ReadMarks, ReadsAStrokeAlongARowFromItsFirstHalfToItsSecond) {
  ColourImage picture(40, 20);
  const StrokeMark& mark = StrokeMarks()[3];
  for (int x = 10; x < 30; ++x) picture.At(x, 7) = x < 20 ? mark.second_half : mark.first_half;
  const Marks marks = ReadMarks(picture);
  ASSERT_TRUE(marks.strokes[3]);
  EXPECT_NEAR(marks.strokes[3]->a.y, 7.5, 1e-9);
  EXPECT_NEAR(marks.strokes[3]->b.y, 7.5, 1e-9);
  EXPECT_NEAR(marks.strokes[3]->a.x, 28.5, 0.51);
  EXPECT_NEAR(marks.strokes[3]->b.x, 11.5, 0.51);
}

TEST(ReadMarks, ReportsWhatIsNotThereAsMissing) {
  ColourImage picture(40, 20, {1, 2, 3});  // no colour of the palette
  picture.At(5, 5) = StrokeMarks()[0].first_half;
  const Marks marks = ReadMarks(picture);
  for (const auto& stroke : marks.strokes) EXPECT_FALSE(stroke) << "also with one shade alone: its sense is unknown";
  for (const auto& effector : marks.effectors) EXPECT_FALSE(effector);
}

}  // namespace
}  // namespace etude
