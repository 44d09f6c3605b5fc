#include "sim/annotator/drawing.h"

#include <gtest/gtest.h>

#include "tests/sim/annotator/annotated_body.h"

namespace etude {
namespace {

TEST(DrawMarks, IsReadBackMarkByMark) {
  Marks marks;
  for (std::size_t i = 0; i < kStrokeCount; i += 2) {
    const double y = 12.0 + 14.0 * static_cast<double>(i);
    marks.strokes[i] = PixelSegment{{20, y}, {90, y + 6}};
  }
  marks.effectors[1] = {130.5, 40.5};
  const Marks read = ReadMarks(DrawMarks(marks, 160, 220));
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    ASSERT_EQ(read.strokes[i].has_value(), marks.strokes[i].has_value()) << i;
    if (!read.strokes[i]) continue;
    EXPECT_LT(glm::distance(read.strokes[i]->a, marks.strokes[i]->a), 0.7) << i;
    EXPECT_LT(glm::distance(read.strokes[i]->b, marks.strokes[i]->b), 0.7) << i;
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    ASSERT_EQ(read.effectors[i].has_value(), i == 1) << i;
  }
  EXPECT_LT(glm::distance(*read.effectors[1], *marks.effectors[1]), 0.3);
}

TEST(DrawDisc, IsReadBackWhenHalfOfItIsCovered) {
  const auto marks = EffectorMarks();
  for (const glm::dvec2 shift : {glm::dvec2(4, 0), glm::dvec2(0, -3.3), glm::dvec2(2.9, 2.9)}) {
    ColourImage picture(60, 60);
    const glm::dvec2 centre(30.3, 28.8);
    DrawDisc(centre, marks[0], picture);
    DrawDisc(centre + shift, marks[1], picture);
    const Marks read = ReadMarks(picture);
    ASSERT_TRUE(read.effectors[0] && read.effectors[1]);
    EXPECT_LT(glm::distance(*read.effectors[0], centre), 1);
    EXPECT_LT(glm::distance(*read.effectors[1], centre + shift), 0.3);
  }
}

TEST(DrawStroke, IsReadBackWhenAnotherCrossesIt) {
  const auto marks = StrokeMarks();
  ColourImage picture(100, 100);
  const PixelSegment segment{{20, 30}, {80, 62}};
  DrawStroke(segment, marks[0], picture);
  DrawStroke({{25, 80}, {60, 20}}, marks[1], picture);
  const Marks read = ReadMarks(picture);
  ASSERT_TRUE(read.strokes[0]);
  EXPECT_LT(LineDistance(segment.a, *read.strokes[0]), 1);
  EXPECT_LT(LineDistance(segment.b, *read.strokes[0]), 1);
}

TEST(DrawStroke, CutsOffWhatLiesOutside) {
  ColourImage picture(20, 20);
  DrawStroke({{-50, 10}, {70, 10}}, StrokeMarks()[0], picture);
  DrawStroke({{-500, -500}, {-400, -450}}, StrokeMarks()[1], picture);
  DrawDisc({1e9, -1e9}, EffectorMarks()[0], picture);
  EXPECT_TRUE(picture.At(0, 10) == StrokeMarks()[0].first_half);
  EXPECT_TRUE(picture.At(19, 10) == StrokeMarks()[0].second_half);
  EXPECT_TRUE(picture.At(10, 0) == Rgb8{});
}

}  // namespace
}  // namespace etude
