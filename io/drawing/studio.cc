#include "io/drawing/studio.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "engine/base/smoothstep.h"
#include "io/drawing/look.h"

namespace etude {
namespace {

constexpr glm::dvec3 kEye{0, 1.35, 5.2};
constexpr glm::dvec3 kTarget{0, 0.92, 0};
// The empty border as a share of the picture's size.
constexpr double kBorder = 0.07;
constexpr double kGridSpacing = 0.5;
constexpr double kGridLine = 0.008;
// Between these distances from the origin, in metres, the floor and the shadow fade into the backdrop.
constexpr double kFadeFrom = 1.2, kFadeTo = 2.4;
constexpr glm::vec3 kFloorPaint{0.205, 0.226, 0.248};
constexpr glm::vec3 kGridPaint{0.36, 0.40, 0.43};
constexpr glm::vec3 kBackdropPaint{0.125, 0.142, 0.158};
constexpr float kShadowLeaves = 0.55f;
constexpr glm::vec3 kGhostPaint{0.80, 0.84, 0.87};
constexpr float kGhostStrength = 0.34f;

Camera CameraOf(const Intrinsics& inside) { return LookAt(inside, kEye, kTarget); }

/// Returns the share of a pixel of the floor that is covered by the grid lines perpendicular to one axis. The pixel is
/// at `x` on this axis and `footprint` wide, metres.
float LineCover(float x, float footprint) {
  constexpr float kSpacing = kGridSpacing, kHalf = kGridLine / 2;
  const float nearest = std::abs(x - kSpacing * std::floor(x / kSpacing + 0.5f));
  const float covered = std::min(nearest + footprint / 2, kHalf) - std::max(nearest - footprint / 2, -kHalf);
  return std::min(std::max(covered / footprint, 0.0f), 1.0f);
}

std::uint32_t ToLevel(float share) { return static_cast<std::uint32_t>(static_cast<int>(share * 255.0f + 0.5f)); }
std::uint32_t ToPixel(const glm::vec3& paint) {
  return ToLevel(paint.r) << 16 | ToLevel(paint.g) << 8 | ToLevel(paint.b);
}

/// Returns a pixel of the floor, blended over the backdrop. `line` is the share of the grid's colour in the floor's
/// colour, `light` is a factor on the brightness, and `fade` is the floor's opacity (0 shows only the backdrop).
std::uint32_t FloorPixel(float line, float light, float fade) {
  const auto level = [&](int i) {
    const float paint = (kFloorPaint[i] + (kGridPaint[i] - kFloorPaint[i]) * line) * light;
    return ToLevel(kBackdropPaint[i] + (paint - kBackdropPaint[i]) * fade);
  };
  return level(0) << 16 | level(1) << 8 | level(2);
}

std::uint32_t BlendedWithGhost(std::uint32_t pixel) {
  const auto level = [&](int i, int shift) {
    const float under = static_cast<float>(pixel >> shift & 255) / 255;
    return ToLevel(under + (kGhostPaint[i] - under) * kGhostStrength) << shift;
  };
  return level(0, 16) | level(1, 8) | level(2, 0);
}

constexpr double kFreeRoom = 0.45;

}  // namespace

Figure Placed(Figure figure, const FloorMove& move) {
  const FloorMove turn{move.yaw, 0, 0};
  for (Capsule& capsule : figure.shape) {
    capsule.a = move.Apply(capsule.a);
    capsule.b = move.Apply(capsule.b);
  }
  for (Surface& surface : figure.surfaces) {
    for (glm::dvec3& position : surface.positions) position = move.Apply(position);
    for (glm::dvec3& normal : surface.normals) normal = turn.Apply(normal);
  }
  return figure;
}

void Studio::Include(const Figure& placed, ViewBounds& bounds) {
  const Camera camera = CameraOf({});
  const auto include = [&](const glm::dvec3& point, double radius) {
    constexpr double kMinDistance = 0.5;  // metres in front of the camera; nearer points are clamped
    const glm::dvec3 seen = camera.R_CW * (point - camera.p_WC);
    const double distance = std::max(seen.z, kMinDistance);
    const glm::dvec2 tangents(seen.x / distance, seen.y / distance);
    bounds.low = glm::min(bounds.low, tangents - radius / distance);
    bounds.high = glm::max(bounds.high, tangents + radius / distance);
  };
  for (const Capsule& capsule : placed.shape) {
    include(capsule.a, capsule.radius);
    include(capsule.b, capsule.radius);
  }
  for (const Surface& surface : placed.surfaces) {
    for (const glm::dvec3& position : surface.positions) include(position, 0);
  }
}

Studio::Studio(int width, int height, double detail, const ViewBounds& bounds)
    : small_(width, height),
      shrinker_(static_cast<int>(width * detail), static_cast<int>(height * detail), width, height) {
  // Choose the focal length so that the bounds fit between the borders.
  Intrinsics inside;
  inside.width = static_cast<int>(width * detail);
  inside.height = static_cast<int>(height * detail);
  const glm::dvec2 room = (1 - 2 * kBorder) * glm::dvec2(inside.width, inside.height);
  const glm::dvec2 extent = glm::max(bounds.high - bounds.low, 0.05);
  inside.fx = inside.fy = std::min(room.x / extent.x, room.y / extent.y);
  const glm::dvec2 middle = 0.5 * (bounds.low + bounds.high);
  inside.cx = inside.width / 2.0 - inside.fx * middle.x;
  // Leave more room above the head than at the other borders.
  inside.cy = inside.height * (1 - kBorder) - inside.fy * bounds.high.y;
  camera_ = CameraOf(inside);

  // Intersect the ray of every pixel with the floor.
  const std::size_t pixels = static_cast<std::size_t>(inside.width) * inside.height;
  for (std::vector<float>* part : {&floor_.x, &floor_.z, &floor_.fade}) part->resize(pixels);
  floor_.footprint.resize(pixels, 1);
  const glm::dmat3 R_WC = glm::transpose(camera_.R_CW);
  for (int y = 0; y < inside.height; ++y) {
    for (int x = 0; x < inside.width; ++x) {
      const glm::dvec3 way = R_WC * glm::dvec3((x + 0.5 - inside.cx) / inside.fx, (y + 0.5 - inside.cy) / inside.fy, 1);
      if (!(way.y < 0)) continue;
      const double reach = -kEye.y / way.y;
      const glm::dvec3 point = kEye + reach * way;
      const double fade = 1 - Smoothstep(kFadeFrom, kFadeTo, glm::length(glm::dvec2(point.x, point.z)));
      if (!(fade > 0)) continue;
      const std::size_t i = static_cast<std::size_t>(y) * inside.width + x;
      floor_.x[i] = static_cast<float>(point.x);
      floor_.z[i] = static_cast<float>(point.z);
      floor_.fade[i] = static_cast<float>(fade);
      // At a slant, a pixel covers more floor along the line of sight than across it.
      floor_.footprint[i] = static_cast<float>(reach / inside.fx * std::sqrt(glm::length(way) / -way.y));
      floor_.seen = Union(floor_.seen, {x, y, x + 1, y + 1});
    }
  }
  lit_ = shaded_ = large_ = Image<std::uint32_t>(inside.width, inside.height, ToPixel(kBackdropPaint));
}

void Studio::PaintFloor(const FloorMove& placement) {
  // Express the floor point in the figure's original frame by inverting the placement.
  const float cosine = static_cast<float>(std::cos(placement.yaw)), sine = static_cast<float>(std::sin(placement.yaw));
  const float move_x = static_cast<float>(placement.x), move_z = static_cast<float>(placement.z);
  // Copy the width: the member might alias the written pixels, and then the loop would not vectorise.
  const int width = floor_.seen.Width();
  for (int y = floor_.seen.top; y < floor_.seen.bottom; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * lit_.width + floor_.seen.left;
    const float *xs = &floor_.x[first], *zs = &floor_.z[first];
    const float *fades = &floor_.fade[first], *footprints = &floor_.footprint[first];
    std::uint32_t *lit = &lit_.pixels[first], *shaded = &shaded_.pixels[first];
    for (int i = 0; i < width; ++i) {
      const float x = xs[i] - move_x, z = zs[i] - move_z;
      const float line =
          std::max(LineCover(cosine * x - sine * z, footprints[i]), LineCover(sine * x + cosine * z, footprints[i]));
      lit[i] = FloorPixel(line, 1, fades[i]);
      shaded[i] = FloorPixel(line, kShadowLeaves, fades[i]);
    }
  }
}

void Studio::Compose(const PixelRect& rect, const Mask* ghost) {
  const int width = rect.Width();
  for (int y = rect.top; y < rect.bottom; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * lit_.width + rect.left;
    const std::uint8_t* seen = &figures_.bytes[4 * first];
    const std::uint32_t *lit = &lit_.pixels[first], *shaded = &shaded_.pixels[first];
    std::uint32_t* out = &large_.pixels[first];
    for (int i = 0; i < width; ++i) {
      std::uint32_t rgba = 0;  // the four bytes in memory order
      std::memcpy(&rgba, seen + 4 * i, sizeof rgba);
      const std::uint32_t what = rgba >> 24, body = (rgba & 255) << 16 | (rgba & 0xff00) | (rgba >> 16 & 255);
      const std::uint32_t in_light = lit[i], in_shadow = shaded[i];
      const std::uint32_t ground = what == Overlay::kNothing ? in_light : in_shadow;
      out[i] = what == Overlay::kBody ? body : ground;
    }
    for (int i = 0; ghost != nullptr && i < width; ++i) {
      if (ghost->pixels[first + i] != 0 && seen[4 * i + 3] != Overlay::kBody) out[i] = BlendedWithGhost(out[i]);
    }
  }
}

void Studio::Draw(Canvas& canvas, const Box& box, Renderer& renderer, const Figure& placed, const FloorMove& placement,
                  const Mask* ghost) {
  assert(box.width == small_.width && box.height == small_.height);
  // Redraw the pixels that the old figure or the new figure covers.
  PixelRect changed = figures_.drawn;
  renderer.DrawFigures({placed}, camera_, figures_);
  changed = Union(changed, figures_.drawn);
  const bool is_first = !painted_;
  // If the figure's placement on the floor has changed, the whole visible floor must be painted again.
  if (is_first || painted_->yaw != placement.yaw || painted_->x != placement.x || painted_->z != placement.z) {
    PaintFloor(placement);
    painted_ = placement;
    changed = Union(changed, floor_.seen);
  }
  if (is_first || ghost != nullptr || has_ghost_) changed = {0, 0, large_.width, large_.height};
  has_ghost_ = ghost != nullptr;
  Compose(changed, ghost);
  shrinker_.Shrink(large_, changed, small_);
  canvas.Put(small_, static_cast<int>(box.x), static_cast<int>(box.y), kPanelRadius);
}

Mask Studio::Silhouette(Renderer& renderer, const Figure& placed) const {
  Overlay seen;
  renderer.DrawFigures({placed}, camera_, seen);
  Mask mask(seen.width, seen.height);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) mask.pixels[i] = seen.bytes[4 * i + 3] == Overlay::kBody;
  return mask;
}

glm::dvec2 Studio::PixelOf(const Box& box, const glm::dvec3& point) const {
  const glm::dvec2 seen = Project(MatrixOf(camera_), point).value_or(glm::dvec2(0));
  return {box.x + seen.x * box.width / camera_.intrinsics.width,
          box.y + seen.y * box.height / camera_.intrinsics.height};
}

std::vector<glm::dvec3> CameraPath(const BodyMotion& motion, int smoothing) {
  const int count = static_cast<int>(motion.poses.size());
  glm::dvec3 low = motion.poses.front()[Role::kHipCentre], high = low;
  for (const BodyPose& pose : motion.poses) {
    low = glm::min(low, pose[Role::kHipCentre]);
    high = glm::max(high, pose[Role::kHipCentre]);
  }
  const glm::dvec3 half = (high - low) / 2.0;
  if (half.x < kFreeRoom && half.z < kFreeRoom) return std::vector(motion.poses.size(), low + half);
  std::vector<glm::dvec3> way;
  for (int frame = 0; frame < count; ++frame) {
    glm::dvec3 sum{0};
    for (int k = -smoothing; k <= smoothing; ++k) {
      sum += motion.poses[static_cast<std::size_t>(std::clamp(frame + k, 0, count - 1))][Role::kHipCentre];
    }
    way.push_back(sum / (2.0 * smoothing + 1));
  }
  return way;
}

}  // namespace etude
