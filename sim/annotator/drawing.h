#pragma once

#include <glm/glm.hpp>

#include "engine/base/image.h"
#include "engine/vision/strokes.h"

namespace etude {

/// Returns the annotation picture of these marks (engine/vision/strokes.h): strokes on black, discs over them.
ColourImage DrawMarks(const Marks& marks, int width, int height);

/// Draws one stroke from a to b, with the half towards b in the second shade. Parts outside the picture are clipped.
void DrawStroke(const PixelSegment& segment, const StrokeMark& mark, ColourImage& picture);
/// Draws one disc. Parts outside the picture are clipped.
void DrawDisc(const glm::dvec2& centre, const EffectorMark& mark, ColourImage& picture);

}  // namespace etude
