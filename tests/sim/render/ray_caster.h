#pragma once

#include <cmath>
#include <limits>

#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

struct Sight {
  std::uint32_t label = 0;
  double depth = std::numeric_limits<double>::infinity();
};

/// A second implementation of the renderer: one ray at a time, in double precision, with sim/body's HitDistance and a
/// ray-triangle test instead of shaders. The room is the studio, or `interior`, which must outlive this object.
class RayCaster {
 public:
  RayCaster(const Camera& camera, std::vector<Capsule> shape, const std::vector<Surface>& surfaces = {},
            const Interior* interior = nullptr)
      : camera_(camera), shape_(std::move(shape)), interior_(interior) {
    for (const Surface& surface : surfaces) {
      for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        const auto& [a, b, c] = surface.triangles[i];
        triangles_.push_back({surface.parts[i], surface.positions[a], surface.positions[b], surface.positions[c]});
      }
    }
  }

  /// Casts the ray of the point (u, v), in pixels; the centre of pixel (i, j) is (i + 0.5, j + 0.5).
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
    const std::vector<FurnitureBox> no_furniture;
    for (const FurnitureBox& box : interior_ ? interior_->furniture : no_furniture) {
      const double distance = HitDistance(Cuboid{box.centre, box.half_size, box.heading}, camera_.p_WC, direction);
      if (distance >= nearest) continue;
      nearest = distance;
      sight = {static_cast<std::uint32_t>(Part::kFurniture), distance / stretch};
    }
    for (const Capsule& capsule : shape_) {
      const double distance = HitDistance(capsule, camera_.p_WC, direction);
      if (distance >= nearest) continue;
      nearest = distance;
      sight = {static_cast<std::uint32_t>(capsule.part), distance / stretch};
    }
    for (const Triangle& triangle : triangles_) {
      const double distance = triangle.Hit(camera_.p_WC, direction);
      if (distance >= nearest) continue;
      nearest = distance;
      sight = {static_cast<std::uint32_t>(triangle.part), distance / stretch};
    }
    if (nearest == room && std::isfinite(room) && IsInShadow(camera_.p_WC + room * direction)) {
      sight.label = static_cast<std::uint32_t>(Part::kShadow);
    }
    return sight;
  }

  /// Returns true if the label is constant within `margin` pixels of (u, v); false near outlines.
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
  struct Triangle {
    Part part;
    glm::dvec3 a, b, c;

    // Returns the distance of the triangle, hit from either side (Möller and Trumbore 1997).
    double Hit(const glm::dvec3& origin, const glm::dvec3& direction) const {
      constexpr double kNowhere = std::numeric_limits<double>::infinity();
      const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(direction, ac);
      const double determinant = glm::dot(ab, p);
      if (determinant == 0) return kNowhere;
      const glm::dvec3 from_a = origin - a, q = glm::cross(from_a, ab);
      const double u = glm::dot(from_a, p) / determinant, v = glm::dot(direction, q) / determinant;
      if (u < 0 || v < 0 || u + v > 1) return kNowhere;
      const double distance = glm::dot(ac, q) / determinant;
      return distance > 0 ? distance : kNowhere;
    }
  };

  double RoomDistance(const glm::dvec3& direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int axis = 0; interior_ != nullptr && axis < 3; ++axis) {
      const double low = interior_->low[axis] - camera_.p_WC[axis], high = interior_->high[axis] - camera_.p_WC[axis];
      if (low < 0 && direction[axis] < 0) nearest = std::min(nearest, low / direction[axis]);
      if (high > 0 && direction[axis] > 0) nearest = std::min(nearest, high / direction[axis]);
    }
    if (interior_ != nullptr) return nearest;
    if (direction.y < 0) nearest = std::min(nearest, -camera_.p_WC.y / direction.y);
    if (direction.z < 0) nearest = std::min(nearest, (kWallZ - camera_.p_WC.z) / direction.z);
    return nearest;
  }

  bool IsInShadow(const glm::dvec3& point) const {
    const glm::dvec3 to_lamp = (interior_ ? interior_->lights.key : kLamp) - point;
    const double distance = glm::length(to_lamp);
    for (const Capsule& capsule : shape_) {
      if (HitDistance(capsule, point, to_lamp / distance) < distance) return true;
    }
    for (const Triangle& triangle : triangles_) {
      if (triangle.Hit(point, to_lamp / distance) < distance) return true;
    }
    return false;
  }

  Camera camera_;
  std::vector<Capsule> shape_;
  std::vector<Triangle> triangles_;
  const Interior* interior_;
};

struct Comparison {
  int compared = 0;
  int on_outlines = 0;     // differing pixels whose centre lies on an outline
  int wrong_labels = 0;    // differing pixels away from outlines
  double worst_depth = 0;  // largest difference of depth away from outlines, metres
};

/// Compares every third pixel of every third row. A difference within a 20th of a pixel of an outline counts as on it.
inline Comparison Compare(const View& view, const RayCaster& caster) {
  constexpr double kMargin = 0.05;
  Comparison result;
  for (int y = 0; y < view.labels.height; y += 3) {
    for (int x = 0; x < view.labels.width; x += 3) {
      ++result.compared;
      const double u = x + 0.5, v = y + 0.5;
      const Sight expected = caster.Cast(u, v);
      const double difference = std::abs(view.depth.At(x, y) - expected.depth);
      const bool same_label = view.labels.At(x, y) == expected.label;
      if (same_label && difference <= result.worst_depth) continue;
      if (!caster.IsClear(u, v, kMargin)) {
        ++result.on_outlines;
      } else if (!same_label) {
        ++result.wrong_labels;
      } else {
        result.worst_depth = difference;
      }
    }
  }
  return result;
}

/// Returns a usual camera, a camera with unusual values of all intrinsics, and a close camera above the person.
inline std::vector<Camera> TestCameras() {
  const Intrinsics skewed{.width = 501, .height = 377, .fx = 480, .fy = 455, .cx = 230.25, .cy = 201.5, .skew = 14};
  const Intrinsics close{.width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 160, .cy = 120};
  return {LookAt({}, {-1.2, 1.4, 3.9}, {0, 0.95, 0}), LookAt(skewed, {2.1, 0.6, 3.0}, {0.1, 1.0, 0}),
          LookAt(close, {0.4, 2.2, 0.9}, {0, 1.0, 0})};
}

}  // namespace etude
