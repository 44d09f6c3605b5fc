#pragma once

#include <cmath>
#include <limits>

#include "sim/render/renderer.h"

namespace etude {

/// What one viewing ray meets first.
struct Sight {
  std::uint32_t label = 0;
  double depth = std::numeric_limits<double>::infinity();
};

/// The renderer's second implementation: one ray at a time, in double precision, with sim/body's
/// HitDistance instead of shaders.
class RayCaster {
 public:
  RayCaster(const Camera& camera, std::vector<Capsule> shape) : camera_(camera), shape_(std::move(shape)) {}

  /// (u, v) in pixels, the centre of pixel (i, j) being (i + 0.5, j + 0.5).
  Sight Cast(double u, double v) const {
    const Intrinsics& in = camera_.intrinsics;
    const double y = (v - in.cy) / in.fy;
    const double x = (u - in.cx - in.skew * y) / in.fx;
    const glm::dvec3 along = glm::transpose(camera_.R_CW) * glm::dvec3(x, y, 1);
    const double stretch = glm::length(along);  // distance = stretch · depth
    const glm::dvec3 direction = along / stretch;

    Sight sight;
    const double room = RoomDistance(direction);
    sight.depth = room / stretch;
    double nearest = room;
    for (const Capsule& capsule : shape_) {
      const double distance = HitDistance(capsule, camera_.p_WC, direction);
      if (distance >= nearest) continue;
      nearest = distance;
      sight = {static_cast<std::uint32_t>(capsule.part), distance / stretch};
    }
    if (nearest == room && std::isfinite(room) && IsInShadow(camera_.p_WC + room * direction)) {
      sight.label = static_cast<std::uint32_t>(Part::kShadow);
    }
    return sight;
  }

  /// Whether the label is the same all around (u, v), `margin` pixels away: false on outlines.
  bool IsClear(double u, double v, double margin) const {
    const std::uint32_t label = Cast(u, v).label;
    for (const double du : {-margin, 0.0, margin}) {
      for (const double dv : {-margin, 0.0, margin}) {
        if (Cast(u + du, v + dv).label != label) return false;
      }
    }
    return true;
  }

 private:
  double RoomDistance(const glm::dvec3& direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    if (direction.y < 0) nearest = std::min(nearest, -camera_.p_WC.y / direction.y);
    if (direction.z < 0) nearest = std::min(nearest, (kWallZ - camera_.p_WC.z) / direction.z);
    return nearest;
  }

  bool IsInShadow(const glm::dvec3& point) const {
    const glm::dvec3 to_lamp = kLamp - point;
    const double distance = glm::length(to_lamp);
    for (const Capsule& capsule : shape_) {
      if (HitDistance(capsule, point, to_lamp / distance) < distance) return true;
    }
    return false;
  }

  Camera camera_;
  std::vector<Capsule> shape_;
};

}  // namespace etude
