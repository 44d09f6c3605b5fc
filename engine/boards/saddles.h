#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"

namespace etude {

using GreyImage = Image<float>;

/// Converts a picture to brightness, 0…255.
GreyImage ToGrey(const ColourImage& picture);

/// Returns the brightness at a point by bilinear interpolation. Points outside the picture get the brightness of its
/// edge. The picture must have at least 2 × 2 pixels.
double BrightnessAt(const GreyImage& picture, const glm::dvec2& pixel);

/// A saddle point of brightness, between two dark and two bright quadrants: a corner of a chessboard or of a code.
struct Saddle {
  glm::dvec2 pixel{0};
  /// Unit vectors along the two crossing edges. Rotating the first clockwise (u right, v down) to the second sweeps a
  /// bright quadrant.
  std::array<glm::dvec2, 2> edges;
  double strength = 0;
};

/// Finds the saddles of a picture, the strongest first, accurate to about 0.1 pixel if the squares around them have 6
/// pixels or more.
std::vector<Saddle> FindSaddles(const GreyImage& picture);

}  // namespace etude
