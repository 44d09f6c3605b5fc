#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"
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
  /// The contrast to what lies beside it, other than the limbs that it hangs together with: the mean over the left and
  /// right ends of its rows of the distance in RGB between pixels 2 px inside and outside, counts.
  double contrast = 0;
};

/// A picture of a person, segmented into limbs. The trunk is what thighs, upper arms and the head hang from.
struct LimbRegions {
  int width = 0, height = 0;
  Region trunk;
  std::array<Region, kStrokeCount> limbs;  ///< by stroke; the last is the head with the neck
  /// The border between a limb and the part it hangs from: the middles of all pixel sides between them, by stroke.
  std::array<std::vector<glm::dvec2>, kStrokeCount> borders;
};

/// Returns whether the limb of a stroke hangs from the trunk; any other hangs from the limb of the stroke before.
constexpr bool HangsFromTrunk(std::size_t stroke) { return stroke % 3 == 0; }

/// The distance within which a pixel still counts as on the extracted person: extraction frays edges by a pixel or two.
constexpr int kFrayedEdgePx = 3;

/// Returns whether a pixel lies on the person, or at most `margin_px` beside it (in u and in v).
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
  glm::dvec2 along{1, 0};    ///< unit; its sense means nothing
  double low = 0, high = 0;  ///< where the region begins and ends along it, pixels from the origin
  double half_width = 0;     ///< of the region across it, pixels: nine tenths of the rows are narrower
  bool IsLong() const;       ///< clearly longer than wide, so that it has a direction of its own
  glm::dvec2 At(double s) const { return origin + s * along; }
  double Where(const glm::dvec2& p) const { return glm::dot(p - origin, along); }
};

/// Finds the middle line: the principal axis of the region's pixels first; then, where it is long enough, the straight
/// line through the middles of its cross sections (of those that are about as wide as the region: cut off corners say
/// nothing about the middle), least squares. A capsule seen whole from aside gives its axis; the ends are those of its
/// round ends.
/// @param region has pixels
MiddleLine FindMiddleLine(const Region& region);

}  // namespace etude
