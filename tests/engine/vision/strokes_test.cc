#include "engine/vision/strokes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "tests/engine/vision/pen.h"
#include "tests/support/results.h"

namespace etude {
namespace {

// Draws a straight stroke of a round pen, each half in one of the mark's shades: every pixel whose centre is covered.
void DrawStroke(ColourImage& picture, const StrokeMark& mark, const glm::dvec2& from, const glm::dvec2& to) {
  DrawPen(picture.width, picture.height, from, to, kStrokeWidth / 2, /*has_flat_ends=*/false,
          [&](int x, int y, double share) { picture.At(x, y) = share < 0.5 ? mark.first_half : mark.second_half; });
}

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

TEST(ReadMarks, FindsTheEndsOfALimbNotThoseOfThePen) {
  // The pen extends beyond the limb at both ends. Pixel rounding affects each reading, but not the mean.
  constexpr int kDirections = 180;
  double beyond_a = 0, beyond_b = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * kPi * i / kDirections;
    const glm::dvec2 along(std::cos(angle), std::sin(angle));
    const glm::dvec2 middle(40 + 0.37 * (i % 7), 40 + 0.23 * (i % 11)), from = middle - 15.0 * along;
    const glm::dvec2 to = middle + 15.0 * along;
    ColourImage picture(80, 80);
    DrawStroke(picture, StrokeMarks()[5], from, to);
    const Marks marks = ReadMarks(picture);
    ASSERT_TRUE(marks.strokes[5]);
    EXPECT_LT(glm::distance(marks.strokes[5]->a, from), 1) << i;
    EXPECT_LT(glm::distance(marks.strokes[5]->b, to), 1) << i;
    beyond_a += glm::dot(from - marks.strokes[5]->a, along) / kDirections;
    beyond_b += glm::dot(marks.strokes[5]->b - to, along) / kDirections;
  }
  EXPECT_NEAR(beyond_a, 0, 0.25);
  EXPECT_NEAR(beyond_b, 0, 0.25);
}

void DrawDisc(ColourImage& picture, const EffectorMark& mark, const glm::dvec2& centre) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      if (glm::distance(pixel, centre) < kDiscRadius) picture.At(x, y) = mark.colour;
    }
  }
}

TEST(ReadMarks, FindsTheCentreOfADiscWhereverItsPixelsFall) {
  for (int i = 0; i < 100; ++i) {
    const glm::dvec2 centre(20 + 0.1 * (i % 10), 20 + 0.1 * (i / 10));
    ColourImage picture(40, 40);
    DrawDisc(picture, EffectorMarks()[2], centre);
    ASSERT_OK(found, ReadMarks(picture).effectors[2]);
    EXPECT_LT(glm::distance(*found, centre), 0.2) << i;
  }
}

TEST(ReadMarks, FindsTheCentreOfADiscThatIsPartlyCovered) {
  // The control: the mean of visible pixels is off by 1.33 pixels towards the visible side.
  constexpr int kDirections = 24;
  double error = 0, error_of_mean = 0;
  for (int i = 0; i < kDirections; ++i) {
    const glm::dvec2 centre(20 + 0.05 * i, 20 + 0.035 * i), aside(std::cos(i * kPi / 12), std::sin(i * kPi / 12));
    ColourImage picture(40, 40);
    DrawDisc(picture, EffectorMarks()[2], centre);
    glm::dvec2 sum(0);
    double visible = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const glm::dvec2 pixel(x + 0.5, y + 0.5);
        if (glm::dot(pixel - centre, aside) >= 0.2 * kDiscRadius) picture.At(x, y) = Rgb8{};
        if (picture.At(x, y) == Rgb8{}) continue;
        sum += pixel;
        ++visible;
      }
    }
    ASSERT_OK(found, ReadMarks(picture).effectors[2]);
    error += glm::distance(*found, centre) / kDirections;
    error_of_mean += glm::distance(sum / visible, centre) / kDirections;
  }
  EXPECT_LT(error, 0.9);
  EXPECT_GT(error_of_mean, 1.2);
}

TEST(ReadMarks, ReadsEveryMarkOfThePalette) {
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    ColourImage picture(60, 20);
    DrawStroke(picture, StrokeMarks()[i], {15, 10}, {45, 10});
    const Marks marks = ReadMarks(picture);
    for (std::size_t j = 0; j < kStrokeCount; ++j) EXPECT_EQ(marks.strokes[j].has_value(), i == j) << i << ", " << j;
    EXPECT_LT(marks.strokes[i]->a.x, marks.strokes[i]->b.x);
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    ColourImage picture(20, 20);
    DrawDisc(picture, EffectorMarks()[i], {10, 10});
    const Marks marks = ReadMarks(picture);
    for (std::size_t j = 0; j < kEffectorCount; ++j)
      EXPECT_EQ(marks.effectors[j].has_value(), i == j) << i << ", " << j;
  }
}

TEST(ReadMarks, GivesAShortStrokeSomeLength) {
  // A stroke shorter than the pen is wide: shortened at both ends, it must not reverse.
  ColourImage picture(20, 20);
  picture.At(5, 5) = StrokeMarks()[0].first_half;
  picture.At(6, 5) = StrokeMarks()[0].second_half;
  const Marks marks = ReadMarks(picture);
  ASSERT_TRUE(marks.strokes[0]);
  EXPECT_NEAR(marks.strokes[0]->b.x - marks.strokes[0]->a.x, 0.5, 1e-9) << "half of the pixels' distance";
}

TEST(ReadMarks, ReportsWhatIsNotThereAsMissing) {
  ColourImage picture(40, 20, {1, 2, 3});  // not in the palette
  picture.At(5, 5) = StrokeMarks()[0].first_half;
  const Marks marks = ReadMarks(picture);
  for (const auto& stroke : marks.strokes) EXPECT_FALSE(stroke) << "also with one shade alone: its sense is unknown";
  for (const auto& effector : marks.effectors) EXPECT_FALSE(effector);
}

}  // namespace
}  // namespace etude
