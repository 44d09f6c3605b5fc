#pragma once

#include "reports/films/canvas.h"
#include "reports/transitions/recorded_requests.h"

namespace etude {

/// How high the bars are, in pixels, with their heading.
constexpr double kDistanceBarsHeight = 120;

/// The ten partial distances of the two frames of a transition point, by the features' names, under a line that tells
/// d, the threshold and the branch. A full bar alone reaches the threshold. `point` counts from 0; before the first
/// transition point, and where the recording tells no distances, the bars are empty. The box is kDistanceBarsHeight
/// high.
void DrawDistanceBars(Canvas& canvas, const Box& box, const TransitionFacts& facts, std::optional<std::size_t> point);

/// "d 0.384 < 0.4 · front half"; of one of two points "1 of 2 · d 0.21 < 0.4 · in-between".
std::string PointWords(const TransitionFacts& facts, std::size_t point);

}  // namespace etude
