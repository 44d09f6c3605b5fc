#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace etude {

/// The places that two people marked for the same thing in the same picture, pixels; empty where one did not mark it.
struct MarkedTwice {
  std::optional<glm::dvec2> first, second;
};

/// `annotator_distance_px`: mean distance of what both marked; nothing when they marked nothing both.
std::optional<double> AnnotatorDistancePx(std::span<const MarkedTwice> joints);

/// `annotator_overlap`: of what either marked, the share that both did; nothing when nobody marked anything.
std::optional<double> AnnotatorOverlap(std::span<const MarkedTwice> limbs);

}  // namespace etude
