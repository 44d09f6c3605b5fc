#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"
#include "engine/vision/strokes.h"

namespace etude {

/// A run of neighbouring pixels in one row: x0 ≤ x < x1.
struct PixelRun {
  int y, x0, x1;
};

/// The visible pixels of one limb, or of the trunk.
struct Region {
  std::vector<PixelRun> runs;  ///< from the top, each row from the left
  int pixels = 0;
  glm::dvec2 middle{0};  ///< mean of the pixels' centres
  bool is_cut = false;   ///< true if some of the region's pixels lie at the picture's edge
  /// The contrast between the region and its surroundings: the mean RGB distance, levels, between pixels 2 px inside
  /// and 2 px outside the ends of the region's rows. Attached limbs do not count as surroundings.
  double contrast = 0;
};

/// A picture of a person, segmented into limbs. Thighs, upper arms and the head are attached to the trunk.
struct LimbRegions {
  int width = 0, height = 0;
  Region trunk;
  std::array<Region, kStrokeCount> limbs;  ///< by stroke; the last region is head and neck
  /// The border between each limb and its parent part, by stroke: the midpoints of all pixel edges between the two
  /// regions.
  std::array<std::vector<glm::dvec2>, kStrokeCount> borders;
};

/// Returns true if the limb of a stroke is attached to the trunk. Any other limb is attached to the limb of the stroke
/// before it.
constexpr bool IsAttachedToTrunk(std::size_t stroke) { return stroke % 3 == 0; }

/// A pixel up to this far outside the extracted person still counts as on the person, because segmentation shifts edges
/// by a pixel or two.
constexpr int kFrayedEdgePx = 3;

/// Returns true if a pixel lies on the person, or at most `margin_px` away from the person in u and in v.
inline bool IsNearPerson(const Mask& person, int x, int y, int margin_px) {
  if (person.At(x, y) != 0) return true;
  for (int v = std::max(0, y - margin_px); v <= std::min(person.height - 1, y + margin_px); ++v) {
    for (int u = std::max(0, x - margin_px); u <= std::min(person.width - 1, x + margin_px); ++u) {
      if (person.At(u, v) != 0) return true;
    }
  }
  return false;
}

/// The line along the middle of a region.
struct MiddleLine {
  glm::dvec2 origin{0};
  glm::dvec2 along{1, 0};    ///< unit; its sign is arbitrary
  double low = 0, high = 0;  ///< positions on the line where the region begins and ends, pixels from `origin`
  double half_width = 0;     ///< half width of the region's cross sections, 90th percentile, pixels
  bool IsLong() const;       ///< true if the region is clearly longer than wide, so that its direction is known
  /// Returns the point of the line at the position `s`.
  glm::dvec2 At(double s) const { return origin + s * along; }
  /// Returns the position on the line of the point nearest to `p`, pixels from `origin`.
  double Where(const glm::dvec2& p) const { return glm::dot(p - origin, along); }
};

/// Finds the middle line of a region: first the principal axis of its pixels; then, if the region is long enough, a
/// straight line fitted by least squares to the middles of its cross sections. Narrow sections are left out, because
/// the middle of a clipped corner is not the middle of the limb. For a capsule that is fully visible from the side, the
/// result is the capsule's axis, extended to the tips of the round ends.
/// @param region must contain pixels
MiddleLine FindMiddleLine(const Region& region);

}  // namespace etude
