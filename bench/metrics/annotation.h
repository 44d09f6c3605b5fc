#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace etude {

/// The positions that two annotators marked for one joint or limb in one picture, pixels. A position is empty if the
/// annotator did not mark the joint or limb.
struct MarkedTwice {
  std::optional<glm::dvec2> first, second;
};

/// Returns `annotator_distance_px`: the mean distance between the two marks, over the joints that both annotators
/// marked. Returns nothing if there is no such joint.
std::optional<double> AnnotatorDistancePx(std::span<const MarkedTwice> joints);

/// Returns `annotator_overlap`: the number of limbs that both annotators marked, divided by the number that at least
/// one of them marked. Returns nothing if no limb was marked.
std::optional<double> AnnotatorOverlap(std::span<const MarkedTwice> limbs);

}  // namespace etude
