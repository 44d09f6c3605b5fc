#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"

namespace etude {

using GreyImage = Image<float>;

/// Returns the picture's brightness, 0…255.
GreyImage ToGrey(const ColourImage& picture);

/// Returns the brightness at a point, bilinear between pixels; outside the picture that of its edge. At least 2 × 2
/// pixels.
double BrightnessAt(const GreyImage& picture, const glm::dvec2& pixel);

/// A point around which dark and bright quarters take turns: a corner of a chessboard, or of a code on it.
struct Saddle {
  glm::dvec2 pixel{0};
  /// The two edges that cross there, unit: between the first and the second, which is clockwise from it on the screen
  /// (u right, v down), it is bright.
  std::array<glm::dvec2, 2> edges;
  double strength = 0;
};

/// Finds the saddles of a picture, the strongest first, to about 0.1 pixel where the squares around them have 6 pixels
/// or more.
std::vector<Saddle> FindSaddles(const GreyImage& picture);

}  // namespace etude
