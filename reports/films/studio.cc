#include "reports/films/studio.h"

#include <algorithm>
#include <cmath>

#include "engine/base/smoothstep.h"
#include "reports/films/look.h"

namespace etude {
namespace {

constexpr glm::dvec3 kEye{0, 1.35, 5.2};
constexpr glm::dvec3 kTarget{0, 0.92, 0};
// Empty border, in parts of the picture.
constexpr double kBorder = 0.07;
constexpr double kGridSpacing = 0.5;
constexpr double kGridLine = 0.008;
// The floor becomes the backdrop between these distances from the origin; the shadow ends with it, before the room's
// wall.
constexpr double kFadeFrom = 1.2, kFadeTo = 2.4;
constexpr glm::dvec3 kFloorPaint{0.205, 0.226, 0.248};
constexpr glm::dvec3 kGridPaint{0.36, 0.40, 0.43};
constexpr glm::dvec3 kBackdropPaint{0.125, 0.142, 0.158};
constexpr double kShadowLeaves = 0.55;
constexpr glm::dvec3 kGhostPaint{0.80, 0.84, 0.87};
constexpr double kGhostStrength = 0.34;

Camera CameraOf(const Intrinsics& inside) { return LookAt(inside, kEye, kTarget); }

/// Gives the share of a pixel that the lines of the grid across one axis cover.
double LineCover(double x, double footprint) {
  const double nearest = std::abs(x - kGridSpacing * std::round(x / kGridSpacing));
  const double half = kGridLine / 2;
  const double covered = std::min(nearest + footprint / 2, half) - std::max(nearest - footprint / 2, -half);
  return std::clamp(covered / footprint, 0.0, 1.0);
}

Rgb8 ToPixel(const glm::dvec3& paint) {
  const glm::dvec3 rounded = glm::clamp(paint, 0.0, 1.0) * 255.0 + 0.5;
  return {static_cast<std::uint8_t>(rounded.x), static_cast<std::uint8_t>(rounded.y),
          static_cast<std::uint8_t>(rounded.z)};
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
    constexpr double kNearest = 0.5;  // metres before the camera; who comes nearer is cut off
    const glm::dvec3 seen = camera.R_CW * (point - camera.p_WC);
    const double distance = std::max(seen.z, kNearest);
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

Studio::Studio(int width, int height, double detail, const ViewBounds& bounds) {
  Intrinsics inside;
  inside.width = static_cast<int>(width * detail);
  inside.height = static_cast<int>(height * detail);
  const glm::dvec2 room = (1 - 2 * kBorder) * glm::dvec2(inside.width, inside.height);
  const glm::dvec2 extent = glm::max(bounds.high - bounds.low, 0.05);
  inside.fx = inside.fy = std::min(room.x / extent.x, room.y / extent.y);
  const glm::dvec2 middle = 0.5 * (bounds.low + bounds.high);
  inside.cx = inside.width / 2.0 - inside.fx * middle.x;
  // What is left over goes above the head.
  inside.cy = inside.height * (1 - kBorder) - inside.fy * bounds.high.y;
  camera_ = CameraOf(inside);

  rays_.reserve(static_cast<std::size_t>(inside.width) * inside.height);
  const glm::dmat3 R_WC = glm::transpose(camera_.R_CW);
  for (int y = 0; y < inside.height; ++y) {
    for (int x = 0; x < inside.width; ++x) {
      const glm::dvec3 way = R_WC * glm::dvec3((x + 0.5 - inside.cx) / inside.fx, (y + 0.5 - inside.cy) / inside.fy, 1);
      Ray ray;
      if (way.y < 0) {
        const double reach = -kEye.y / way.y;
        const glm::dvec3 point = kEye + reach * way;
        ray.floor = {point.x, point.z};
        ray.fade = 1 - Smoothstep(kFadeFrom, kFadeTo, glm::length(ray.floor));
        // Seen from above at a slant, a pixel covers more floor along the line of sight than across.
        ray.footprint = reach / inside.fx * std::sqrt(glm::length(way) / -way.y);
      }
      rays_.push_back(ray);
    }
  }
}

void Studio::Draw(Canvas& canvas, const Box& box, Renderer& renderer, const Figure& placed, const FloorMove& placement,
                  const Mask* ghost) const {
  View view = renderer.Render(Room{}, {placed}, camera_, Targets::kAll);
  const double cosine = std::cos(placement.yaw), sine = std::sin(placement.yaw);
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const std::uint32_t label = view.labels.pixels[i];
    if (label >= kFirstBodyPart) continue;
    const Ray& ray = rays_[i];
    glm::dvec3 paint = kBackdropPaint;
    if (ray.fade > 0) {
      // The floor as the figure knows it: the placement undone.
      const double x = ray.floor.x - placement.x, z = ray.floor.y - placement.z;
      const double line =
          std::max(LineCover(cosine * x - sine * z, ray.footprint), LineCover(sine * x + cosine * z, ray.footprint));
      glm::dvec3 floor = glm::mix(kFloorPaint, kGridPaint, line);
      if (label == static_cast<std::uint32_t>(Part::kShadow)) floor *= kShadowLeaves;
      paint = glm::mix(paint, floor, ray.fade);
    }
    if (ghost != nullptr && ghost->pixels[i] != 0) paint = glm::mix(paint, kGhostPaint, kGhostStrength);
    view.colour.pixels[i] = ToPixel(paint);
  }
  canvas.DrawImage(view.colour, box, kPanelRadius);
}

Mask Studio::Silhouette(Renderer& renderer, const Figure& placed) const {
  const LabelImage labels = renderer.Render(Room{}, {placed}, camera_, Targets::kAll).labels;
  Mask mask(labels.width, labels.height);
  std::ranges::transform(labels.pixels, mask.pixels.begin(),
                         [](std::uint32_t label) { return label >= kFirstBodyPart; });
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
