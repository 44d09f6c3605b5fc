#pragma once

#include <glm/glm.hpp>

#include "engine/base/image.h"
#include "engine/vision/strokes.h"

namespace etude {

/// Returns the annotation picture that shows these marks (engine/vision/strokes.h): on black, strokes first, discs over
/// them.
ColourImage DrawMarks(const Marks& marks, int width, int height);

/// Draws one stroke from a to b, the second half in the second shade. Parts outside are cut off.
void DrawStroke(const PixelSegment& segment, const StrokeMark& mark, ColourImage& picture);
/// Draws one disc. Parts outside are cut off.
void DrawDisc(const glm::dvec2& centre, const EffectorMark& mark, ColourImage& picture);

}  // namespace etude
