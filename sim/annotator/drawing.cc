#include "sim/annotator/drawing.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

// The pixels of `picture` that are at most `reach` pixels outside the bounding box of the points a and b.
struct Box {
  int x0, x1, y0, y1;  // half-open ranges of columns and rows
};

Box BoxAround(const glm::dvec2& a, const glm::dvec2& b, double reach, const ColourImage& picture) {
  auto cut = [](double value, int size) { return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size))); };
  return {cut(std::floor(std::min(a.x, b.x) - reach), picture.width),
          cut(std::ceil(std::max(a.x, b.x) + reach) + 1, picture.width),
          cut(std::floor(std::min(a.y, b.y) - reach), picture.height),
          cut(std::ceil(std::max(a.y, b.y) + reach) + 1, picture.height)};
}

}  // namespace

void DrawStroke(const PixelSegment& segment, const StrokeMark& mark, ColourImage& picture) {
  const glm::dvec2 along = segment.b - segment.a;
  const double length2 = glm::dot(along, along);
  constexpr double kPen = kStrokeWidth / 2;
  const Box box = BoxAround(segment.a, segment.b, kPen, picture);
  // Colour every pixel whose centre is at most the pen's radius away from the segment.
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const glm::dvec2 centre(x + 0.5, y + 0.5);
      const double t = length2 > 0 ? std::clamp(glm::dot(centre - segment.a, along) / length2, 0.0, 1.0) : 0;
      const glm::dvec2 off = centre - (segment.a + t * along);
      if (glm::dot(off, off) <= kPen * kPen) picture.At(x, y) = t < 0.5 ? mark.first_half : mark.second_half;
    }
  }
}

void DrawDisc(const glm::dvec2& centre, const EffectorMark& mark, ColourImage& picture) {
  const Box box = BoxAround(centre, centre, kDiscRadius, picture);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const glm::dvec2 off = glm::dvec2(x + 0.5, y + 0.5) - centre;
      if (glm::dot(off, off) <= kDiscRadius * kDiscRadius) picture.At(x, y) = mark.colour;
    }
  }
}

ColourImage DrawMarks(const Marks& marks, int width, int height) {
  ColourImage picture(width, height);
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (marks.strokes[i]) DrawStroke(*marks.strokes[i], StrokeMarks()[i], picture);
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (marks.effectors[i]) DrawDisc(*marks.effectors[i], EffectorMarks()[i], picture);
  }
  return picture;
}

}  // namespace etude
