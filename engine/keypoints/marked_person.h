#pragma once

#include "engine/keypoints/people.h"
#include "engine/vision/strokes.h"

namespace etude {

/// What the marks of one picture (paper B, section 4.2) say of landmarks: joints are the ends of strokes, the mean
/// where strokes meet; ends the discs. What is marked has confidence 1.
SeenPerson PersonOf(const Marks& marks);

}  // namespace etude
