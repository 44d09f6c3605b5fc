#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/vision/strokes.h"

namespace etude {

/// Neighbouring pixels of one row: x0 ≤ x < x1.
struct PixelRun {
  int y, x0, x1;
};

/// The pixels of one limb, or of the trunk, that are seen.
struct Region {
  std::vector<PixelRun> runs;  ///< from the top, each row from the left
  int pixels = 0;
  glm::dvec2 middle{0};  ///< mean of the pixels' centres
  bool is_cut = false;   ///< some of its pixels lie at the picture's edge
  /// How far its colours stand apart from what lies beside it, other than the limbs that it hangs together with: mean
  /// over the left and right ends of its rows of the distance in RGB between pixels 2 px inside and outside, counts.
  double contrast = 0;
};

/// A picture of a person in limbs. The trunk is what thighs, upper arms and the head hang from.
struct LimbRegions {
  int width = 0, height = 0;
  Region trunk;
  std::array<Region, kStrokeCount> limbs;  ///< by stroke; the last is the head with the neck
  /// Where a limb touches the part it hangs from: the middles of all pixel sides between them, by stroke.
  std::array<std::vector<glm::dvec2>, kStrokeCount> borders;
};

/// Whether the limb of a stroke hangs from the trunk; any other hangs from the limb of the stroke before.
constexpr bool HangsFromTrunk(std::size_t stroke) { return stroke % 3 == 0; }

}  // namespace etude
