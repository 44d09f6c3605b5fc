#include "sim/render/touched_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace etude {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// An axis-aligned box in the world. It is empty until a point is added.
struct Extent {
  glm::dvec3 low{kInfinity}, high{-kInfinity};

  void Add(const glm::dvec3& point, double radius = 0) {
    low = glm::min(low, point - radius);
    high = glm::max(high, point + radius);
  }
  bool IsEmpty() const { return !(low.x <= high.x); }
  std::array<glm::dvec3, 8> Corners() const {
    std::array<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
      corners[i] = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    }
    return corners;
  }
};

bool IsFinitePoint(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// The bounding rectangle of projected points. The projection of a point behind the camera may be anywhere; the
// rectangle is then the whole picture.
class SeenRect {
 public:
  explicit SeenRect(const Camera& camera) : camera_(camera) {}

  void Add(const Extent& extent) {
    if (extent.IsEmpty()) return;
    for (const glm::dvec3& corner : extent.Corners()) Add(corner);
  }
  void AddEverything() { low_ = glm::dvec2(-kInfinity), high_ = glm::dvec2(kInfinity); }

  PixelRect Pixels(const RowRange& rows) const {
    constexpr double kMargin = 2;  // pixels, for rounding errors of floats
    const auto clamp = [](double value, int low, int high) {
      return static_cast<int>(std::clamp(std::floor(value), static_cast<double>(low), static_cast<double>(high)));
    };
    if (!(low_.x <= high_.x)) return {};
    const Intrinsics& in = camera_.intrinsics;
    return {clamp(low_.x - kMargin, 0, in.width), clamp(low_.y - kMargin, rows.first, rows.end),
            clamp(high_.x + kMargin + 1, 0, in.width), clamp(high_.y + kMargin + 1, rows.first, rows.end)};
  }

 private:
  void Add(const glm::dvec3& point) {
    const glm::dvec3 p = camera_.R_CW * (point - camera_.p_WC);
    constexpr double kNear = 0.02;
    if (!(p.z > kNear)) {
      AddEverything();
      return;
    }
    const Intrinsics& in = camera_.intrinsics;
    const glm::dvec2 pixel((in.fx * p.x + in.skew * p.y) / p.z + in.cx, in.fy * p.y / p.z + in.cy);
    low_ = glm::min(low_, pixel);
    high_ = glm::max(high_, pixel);
  }

  const Camera& camera_;
  glm::dvec2 low_{kInfinity}, high_{-kInfinity};
};

// Returns the shadow of an extent on one plane of the room, clipped to the room.
Extent ShadowOn(const Extent& extent, const glm::dvec3& lamp, int axis, double plane, const Extent& room) {
  Extent shadow;
  const double reach = std::abs(lamp[axis] - plane), side = lamp[axis] > plane ? 1 : -1;
  for (const glm::dvec3& corner : extent.Corners()) {
    const glm::dvec3 from_lamp = corner - lamp;
    const double fall = std::max(-side * from_lamp[axis], 0.05);  // distance from the lamp towards the plane, ≥ 5 cm
    glm::dvec3 point = lamp + from_lamp * (reach / fall);
    point[axis] = plane;
    shadow.Add(point);
  }
  for (int i = 0; i < 3; ++i) {
    if (shadow.high[i] < room.low[i] || shadow.low[i] > room.high[i]) return {};
  }
  shadow.low = glm::clamp(shadow.low, room.low, room.high);
  shadow.high = glm::clamp(shadow.high, room.low, room.high);
  return shadow;
}

// Return one extent per capsule, or one per surface. Points with non-finite coordinates are left out.
std::vector<Extent> ExtentsOf(const std::vector<Capsule>& shape) {
  std::vector<Extent> extents;
  for (const Capsule& capsule : shape) {
    if (!IsFinitePoint(capsule.a) || !IsFinitePoint(capsule.b) || !(capsule.radius > 0)) continue;
    Extent& extent = extents.emplace_back();
    extent.Add(capsule.a, 1.02 * capsule.radius);
    extent.Add(capsule.b, 1.02 * capsule.radius);
  }
  return extents;
}

std::vector<Extent> ExtentsOf(const std::vector<Surface>& surfaces) {
  std::vector<Extent> extents;
  for (const Surface& surface : surfaces) {
    Extent& extent = extents.emplace_back();
    for (const glm::dvec3& position : surface.positions) {
      if (IsFinitePoint(position)) extent.Add(position);
    }
    if (extent.IsEmpty()) extents.pop_back();
  }
  return extents;
}

int Area(const PixelRect& rect) { return rect.Width() * rect.Height(); }

// Merges pairs of rectangles whose union has at most 10 % more pixels than the two rectangles together.
void Merge(std::vector<PixelRect>& rects) {
  std::erase_if(rects, [](const PixelRect& rect) { return rect.IsEmpty(); });
  for (std::size_t i = 0; i < rects.size(); ++i) {
    for (std::size_t k = i + 1; k < rects.size(); ++k) {
      const PixelRect both = Union(rects[i], rects[k]);
      if (Area(both) > 1.1 * (Area(rects[i]) + Area(rects[k]))) continue;
      rects[i] = both;
      rects.erase(rects.begin() + static_cast<std::ptrdiff_t>(k));
      i = static_cast<std::size_t>(-1);  // restart, because the union may merge with other rectangles
      break;
    }
  }
}

}  // namespace

std::vector<PixelRect> TouchedPixels(const Room& room, const std::vector<Figure>& figures, const Camera& camera,
                                     const RowRange& rows, bool with_wall) {
  std::vector<PixelRect> rects;
  for (const Figure& figure : figures) {
    SeenRect body(camera), on_floor(camera), on_wall(camera);
    for (const Extent& extent : ExtentsOf(figure.shape)) body.Add(extent);
    for (const Extent& extent : ExtentsOf(figure.surfaces)) {
      body.Add(extent);
      if (!room.casts_shadows || room.interior != nullptr) continue;
      const Extent open{{-kInfinity, 0, kWallZ}, glm::dvec3(kInfinity)};
      on_floor.Add(ShadowOn(extent, kLamp, 1, 0, open));
      if (with_wall) on_wall.Add(ShadowOn(extent, kLamp, 2, kWallZ, open));
    }
    for (const SeenRect* seen : {&body, &on_floor, &on_wall}) rects.push_back(seen->Pixels(rows));
  }
  Merge(rects);
  return rects;
}

}  // namespace etude
