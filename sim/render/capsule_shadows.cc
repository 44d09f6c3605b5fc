#include "sim/render/capsule_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/render/empty_room.h"

namespace etude {
namespace {

// The distance from the body, metres, up to which the body's contact shadow darkens the surface below the body.
constexpr float kContactReach = 0.12f;
// A margin for the rounding of pixels' positions, which are computed in single precision.
constexpr double kFloatMargin = 1e-3;
// Capsules with a coordinate of at least this magnitude, metres, cast no shadow.
constexpr double kMaxCasterDistance = 1e4;

float Clamp01(float value) { return std::min(std::max(value, 0.0f), 1.0f); }

bool CanCastShadow(const Capsule& capsule) {
  return glm::all(glm::lessThan(glm::abs(capsule.a), glm::dvec3(kMaxCasterDistance))) &&
         glm::all(glm::lessThan(glm::abs(capsule.b), glm::dvec3(kMaxCasterDistance))) && capsule.radius > 0;
}

// Consecutive pixels of one row of a LampView.
struct PixelRow {
  const float *x, *y, *z;
  int count;
};

// A capsule seen from the lamp: its axis is start + t · along, 0 ≤ t ≤ 1, metres from the lamp.
class Caster {
 public:
  Caster(const Capsule& capsule, const glm::dvec3& lamp)
      : start_(capsule.a - lamp), along_(capsule.b - capsule.a), radius_(capsule.radius) {
    const glm::dvec3 centre = start_ + 0.5 * along_;
    const double distance = glm::length(centre), reach = 0.5 * glm::length(along_) + radius_;
    const bool is_apart = reach < distance;
    const double sine = reach / distance;
    middle_ = is_apart ? centre / distance : glm::dvec3(0, 1, 0);
    spread_ = is_apart ? std::sqrt(2 - 2 * std::sqrt(1 - sine * sine)) : 2;
    nearest_ = distance - reach;
    farthest_ = std::max(glm::length(start_), glm::length(start_ + along_));
    is_near_floor_ = std::min(capsule.a.y, capsule.b.y) - radius_ < kContactReach;
  }

  // Returns false only if no pixel of the tile can be in the capsule's shadow.
  bool MayDarken(const RoomTile& tile) const {
    if (tile.farthest < nearest_ - kFloatMargin) return false;
    const glm::dvec3 apart = tile.middle - middle_;
    const double both = tile.spread + spread_ + kFloatMargin;
    if (glm::dot(apart, apart) > both * both) return false;
    // Compute the distance of the capsule's axis from the line through the lamp in the tile's middle direction. The
    // tile's other rays deviate from this direction by up to `spread`. At a distance d from the lamp, such a ray is at
    // most d · `spread` closer to the axis.
    const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, tile.middle) * tile.middle; };
    const glm::dvec3 from = across(start_), direction = across(along_);
    const double square = glm::dot(direction, direction);
    const double share = square > 0 ? std::clamp(-glm::dot(from, direction) / square, 0.0, 1.0) : 0;
    const glm::dvec3 gap = from + share * direction;
    const double reach = radius_ + farthest_ * (tile.spread + kFloatMargin);
    return glm::dot(gap, gap) <= reach * reach;
  }

  // Returns false only if no pixel of the tile can be within kContactReach of the capsule, which must be on or near the
  // floor.
  bool MayTouch(const RoomTile& tile) const {
    if (!is_near_floor_) return false;
    const double square = glm::dot(along_, along_);
    const double share = square > 0 ? std::clamp(glm::dot(tile.centre - start_, along_) / square, 0.0, 1.0) : 0;
    const double gap = glm::distance(tile.centre, start_ + share * along_);
    return gap <= tile.radius + radius_ + kContactReach + kFloatMargin;
  }

  // Raises the darkness of each pixel at least to the darkness of this capsule's shadow: 0 outside, 1 deep inside. The
  // line from the lamp to the pixel's point w is one segment, and the capsule's axis another; their distance is
  // computed as in Ericson 2005, section 5.1.9.
  void Darken(const PixelRow& row, float* darkness) const {
    const glm::vec3 a(start_), v(along_);
    const float aa = glm::dot(a, a), va = glm::dot(v, a), vv = glm::dot(v, v);
    const float per_vv = vv > 0 ? 1 / vv : 0, per_radius = static_cast<float>(1 / radius_);
    for (int i = 0; i < row.count; ++i) {
      // Compute the closest points of the two segments.
      const float x = row.x[i], y = row.y[i], z = row.z[i];
      const float ww = x * x + y * y + z * z, wa = x * a.x + y * a.y + z * a.z, wv = x * v.x + y * v.y + z * v.z;
      const float determinant = std::max(ww * vv - wv * wv, 1e-12f);
      const float at_first = Clamp01((wa * vv - wv * va) / determinant);
      const float t = Clamp01((wv * at_first - va) * per_vv);
      const float s = Clamp01((wv * t + wa) / ww);
      // Compute how deep the line runs inside the capsule, and the shadow's softness from the distance between capsule
      // and pixel.
      const float gx = s * x - a.x - t * v.x, gy = s * y - a.y - t * v.y, gz = s * z - a.z - t * v.z;
      const float inside = 1 - std::sqrt(gx * gx + gy * gy + gz * gz) * per_radius;
      const float away = std::sqrt(std::max(ww - 2 * wa + aa, 0.0f));
      const float softness = std::min(std::max(0.2f * away, 0.15f), 0.6f);
      const float u = Clamp01(inside / softness);
      darkness[i] = std::max(darkness[i], u * u * (3 - 2 * u));
    }
  }

  // Raises each pixel's value in `nearness` to at least its nearness to this capsule: 1 at the capsule's skin, 0 at
  // the distance kContactReach from the skin.
  void Touch(const PixelRow& row, float* nearness) const {
    const glm::vec3 a(start_), v(along_);
    const float vv = glm::dot(v, v), per_vv = vv > 0 ? 1 / vv : 0, radius = static_cast<float>(radius_);
    for (int i = 0; i < row.count; ++i) {
      const float x = row.x[i] - a.x, y = row.y[i] - a.y, z = row.z[i] - a.z;
      const float t = Clamp01((x * v.x + y * v.y + z * v.z) * per_vv);
      const float gx = x - t * v.x, gy = y - t * v.y, gz = z - t * v.z;
      const float gap = std::max(std::sqrt(gx * gx + gy * gy + gz * gz) - radius, 0.0f);
      nearness[i] = std::max(nearness[i], 1 - gap * (1 / kContactReach));
    }
  }

 private:
  glm::dvec3 start_, along_;
  double radius_;
  glm::dvec3 middle_;  // unit axis of a cone at the lamp that contains the capsule
  double spread_;      // largest deviation of a direction in the cone from `middle_`, measured like RoomTile::spread
  double nearest_, farthest_;
  bool is_near_floor_;
};

std::vector<Caster> CastersOf(const std::vector<Figure>& figures, bool is_interior, const glm::dvec3& lamp) {
  std::vector<Caster> casters;
  const auto add = [&](const std::vector<Capsule>& shape) {
    for (const Capsule& capsule : shape) {
      if (CanCastShadow(capsule)) casters.emplace_back(capsule, lamp);
    }
  };
  for (const Figure& figure : figures) {
    add(figure.shape);
    if (is_interior) add(figure.shadow);
  }
  return casters;
}

// The darkening of one tile's pixels by all capsules.
struct TileShade {
  std::array<float, kRoomTileSize * kRoomTileSize> darkness, nearness;
  bool is_dark = false, is_touched = false;
};

TileShade Shade(const std::vector<Caster>& casters, bool with_contacts, const LampView& lamp, const RoomTile& tile,
                const PixelRect& pixels, int width) {
  TileShade shade;
  const auto add = [&](auto kernel, std::array<float, kRoomTileSize * kRoomTileSize>& values, bool& is_used) {
    if (!is_used) values.fill(0);
    is_used = true;
    for (int y = pixels.top; y < pixels.bottom; ++y) {
      const std::size_t first = static_cast<std::size_t>(y) * width + pixels.left;
      kernel(PixelRow{&lamp.x[first], &lamp.y[first], &lamp.z[first], pixels.Width()},
             &values[static_cast<std::size_t>(y - pixels.top) * kRoomTileSize]);
    }
  };
  for (const Caster& caster : casters) {
    if (caster.MayDarken(tile)) {
      add([&](const PixelRow& row, float* values) { caster.Darken(row, values); }, shade.darkness, shade.is_dark);
    }
    if (with_contacts && caster.MayTouch(tile)) {
      add([&](const PixelRow& row, float* values) { caster.Touch(row, values); }, shade.nearness, shade.is_touched);
    }
  }
  if (shade.is_dark != shade.is_touched) (shade.is_dark ? shade.nearness : shade.darkness).fill(0);
  return shade;
}

void Paint(const KeptRoom& kept, const TileShade& shade, double brightness, const PixelRect& pixels, bool labels,
           int top_row, View& view) {
  // In each row, darken the light, then convert the light to bytes.
  const std::size_t width = static_cast<std::size_t>(view.colour.width);
  std::array<float, 3 * kRoomTileSize> light;
  for (int y = pixels.top; y < pixels.bottom; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * width + pixels.left;
    const float* darkness = &shade.darkness[static_cast<std::size_t>(y - pixels.top) * kRoomTileSize];
    const float* nearness = &shade.nearness[static_cast<std::size_t>(y - pixels.top) * kRoomTileSize];
    for (int x = 0; x < pixels.Width(); ++x) {
      const float near = std::max(nearness[x], 0.0f), contact = near * near * near;
      for (int c = 0; c < 3; ++c) {
        const std::size_t at = 3 * (first + x) + c;
        const float share = kept.lamp_shares[at];
        const float remaining = std::min(1 - darkness[x] * share, 1 - contact * (0.55f - 0.3f * share));
        light[3 * x + c] = kept.colours[at] * remaining;
      }
    }
    RoundToBytes(light.data(), 3 * static_cast<std::size_t>(pixels.Width()), static_cast<float>(brightness),
                 reinterpret_cast<std::uint8_t*>(&view.colour.At(pixels.left, y - top_row)));
    // Label the shadows.
    if (!labels) continue;
    std::uint32_t* label = &view.labels.At(pixels.left, y - top_row);
    for (int x = 0; x < pixels.Width(); ++x) {
      if (darkness[x] > 0 && label[x] == 0) label[x] = static_cast<std::uint32_t>(Part::kShadow);
    }
  }
}

}  // namespace

void CastCapsuleShadows(const KeptRoom& kept, const Room& room, const std::vector<Figure>& figures, Targets targets,
                        const RowRange& rows, View& view) {
  const bool is_interior = room.interior != nullptr;
  const std::vector<Caster> casters = CastersOf(figures, is_interior, kept.lamp.lamp);
  for (const RoomTile& tile : kept.lamp.tiles) {
    const PixelRect pixels{tile.pixels.left, std::max(tile.pixels.top, rows.first), tile.pixels.right,
                           std::min(tile.pixels.bottom, rows.end)};
    if (pixels.IsEmpty()) continue;
    const TileShade shade = Shade(casters, is_interior, kept.lamp, tile, pixels, view.colour.width);
    if (!shade.is_dark && !shade.is_touched) continue;
    Paint(kept, shade, room.brightness, pixels, targets != Targets::kColour, rows.first, view);
  }
}

void MarkCapsuleShadows(const KeptRoom& kept, const std::vector<Figure>& figures, Overlay& overlay) {
  const std::vector<Caster> casters = CastersOf(figures, /*is_interior=*/false, kept.lamp.lamp);
  if (casters.empty()) return;
  for (const RoomTile& tile : kept.lamp.tiles) {
    const TileShade shade = Shade(casters, /*with_contacts=*/false, kept.lamp, tile, tile.pixels, overlay.width);
    if (!shade.is_dark) continue;
    overlay.drawn = Union(overlay.drawn, tile.pixels);
    for (int y = tile.pixels.top; y < tile.pixels.bottom; ++y) {
      const float* darkness = &shade.darkness[static_cast<std::size_t>(y - tile.pixels.top) * kRoomTileSize];
      std::uint8_t* pixel = &overlay.bytes[4 * (static_cast<std::size_t>(y) * overlay.width + tile.pixels.left)];
      for (int x = 0; x < tile.pixels.Width(); ++x, pixel += 4) {
        if (darkness[x] > 0 && pixel[3] == Overlay::kNothing) pixel[3] = Overlay::kShadow;
      }
    }
  }
}

}  // namespace etude
