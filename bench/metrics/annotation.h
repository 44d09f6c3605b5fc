#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace etude {

/// The positions that two annotators marked for the same joint or limb in the same picture, pixels; empty if one did
/// not mark it.
struct MarkedTwice {
  std::optional<glm::dvec2> first, second;
};

/// Returns `annotator_distance_px`: the mean distance of what both marked; nothing if both marked nothing in common.
std::optional<double> AnnotatorDistancePx(std::span<const MarkedTwice> joints);

/// Returns `annotator_overlap`: the share, of what at least one marked, that both marked; nothing if none was marked.
std::optional<double> AnnotatorOverlap(std::span<const MarkedTwice> limbs);

}  // namespace etude
