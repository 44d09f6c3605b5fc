#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "engine/boards/saddles.h"

namespace etude {

/// Finds the middle of the dark disc on a bright ground next to a pointer: its darkness's centroid, to about 0.05 pixel
/// where it is 6 pixels wide or more. A disc seen aside is an ellipse, of which this is the middle; that of the disc
/// itself lies off by less than (radius / distance)² of its distance. Nothing where no dark piece of an ellipse's
/// shape, at least 3 pixels wide, lies within `reach_px` of the pointer, or where it does not end within `widest_px`.
std::optional<glm::dvec2> FindDisc(const GreyImage& picture, const glm::dvec2& pointer, double reach_px,
                                   double widest_px);

}  // namespace etude
