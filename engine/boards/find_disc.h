#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "engine/boards/saddles.h"

namespace etude {

/// Finds the centre of the dark disc on a bright background near `pointer`: the centroid of its darkness, accurate to
/// about 0.05 pixel for discs of 6 pixels or more. A disc seen at an angle is an ellipse, and this is the centre of the
/// ellipse. The ellipse's centre differs from the picture of the disc's centre; the difference, projected back to the
/// disc, is less than radius² / (distance from the camera). Returns nullopt if no dark region of elliptic shape, at
/// least 3 pixels wide, lies within `reach_px` of the pointer, or if that region is wider than `max_width_px`.
std::optional<glm::dvec2> FindDisc(const GreyImage& picture, const glm::dvec2& pointer, double reach_px,
                                   double max_width_px);

}  // namespace etude
