#pragma once

#include <glm/glm.hpp>

#include "engine/vision/limb_regions.h"

namespace etude {

/// The line along the middle of a region, as the eye lays it into a limb.
struct MiddleLine {
  glm::dvec2 origin{0};
  glm::dvec2 along{1, 0};    ///< unit; its sense means nothing
  double low = 0, high = 0;  ///< where the region begins and ends along it, pixels from the origin
  double half_width = 0;     ///< of the region across it, pixels: nine tenths of the rows are narrower
  bool IsLong() const;       ///< clearly longer than wide, so that it has a direction of its own
  glm::dvec2 At(double s) const { return origin + s * along; }
  double Where(const glm::dvec2& p) const { return glm::dot(p - origin, along); }
};

/// The principal axis of the region's pixels first; then, where it is long enough, the straight line through the
/// middles of its cross sections (of those that are about as wide as the region: cut off corners say nothing about
/// the middle), least squares. A capsule seen whole from aside gives its axis; the ends are those of its round ends.
/// @param region has pixels
MiddleLine FindMiddleLine(const Region& region);

}  // namespace etude
