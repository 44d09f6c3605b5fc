#include "engine/silhouettes/silhouette_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etude {
namespace {

constexpr double kNearest = 0.05;  // metres in front of the camera; a capsule with a nearer end is not projected

struct ConePoint {
  double along = 0;     // 0 at a, 1 at b
  double distance = 0;  // from the pixel to the point of the axis there
  double signed_distance = 0;
};

// Finds the nearest point of a round cone in two dimensions. Along the axis, the distance minus the radius is minimal
// where (x − along·length) / distance = −(radius_b − radius_a) / length.
ConePoint NearestOnCone(const ProjectedCapsule& capsule, const glm::dvec2& pixel) {
  const glm::dvec2 axis = capsule.b - capsule.a, from_a = pixel - capsule.a;
  const double length2 = glm::dot(axis, axis), widens = capsule.radius_b - capsule.radius_a;
  ConePoint found;
  if (length2 <= widens * widens) {
    found.along = widens > 0 ? 1 : 0;  // one end's circle contains the other's
  } else {
    const double x = glm::dot(from_a, axis), y = std::abs(from_a.x * axis.y - from_a.y * axis.x);
    found.along = std::clamp((x + y * widens / std::sqrt(length2 - widens * widens)) / length2, 0.0, 1.0);
  }
  found.distance = glm::length(from_a - found.along * axis);
  found.signed_distance = found.distance - (capsule.radius_a + found.along * widens);
  return found;
}

// A circle around a projected capsule. No point of the capsule's outline is nearer to a pixel than the circle.
struct Bound {
  glm::dvec2 centre{0};
  double radius = 0;
};

std::vector<Bound> BoundsOf(const std::vector<ProjectedCapsule>& flesh) {
  std::vector<Bound> bounds;
  for (const ProjectedCapsule& capsule : flesh) {
    bounds.push_back({0.5 * (capsule.a + capsule.b),
                      0.5 * glm::distance(capsule.a, capsule.b) + std::max(capsule.radius_a, capsule.radius_b)});
  }
  return bounds;
}

// Returns the capsule whose outline is nearest to the pixel and lowers `distance` to its signed distance; returns −1 if
// no capsule is nearer than `distance`.
int NearestCapsule(const std::vector<ProjectedCapsule>& flesh, const std::vector<Bound>& bounds,
                   const glm::dvec2& pixel, double& distance) {
  int nearest = -1;
  for (std::size_t i = 0; i < flesh.size(); ++i) {
    if (!flesh[i].is_valid) continue;
    const glm::dvec2 away = pixel - bounds[i].centre;
    const double reach = distance + bounds[i].radius;
    if (reach <= 0 || glm::dot(away, away) >= reach * reach) continue;
    const double found = NearestOnCone(flesh[i], pixel).signed_distance;
    if (found >= distance) continue;
    distance = found;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

void AppendOutline(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                   std::vector<SilhouetteResidual>& out) {
  const std::vector<Bound> bounds = BoundsOf(flesh);
  for (const OutlinePoint& point : silhouette.outline) {
    double distance = std::numeric_limits<double>::infinity();
    const int owner = NearestCapsule(flesh, bounds, point.pixel, distance);
    if (owner < 0) continue;
    SilhouetteResidual& residual = out.emplace_back(DistanceTo(flesh[owner], point.pixel));
    residual.capsule = owner;
  }
}

}  // namespace

void ProjectFlesh(const SilhouetteBody& body, const TreeFrames& frames, const ProjectionMatrix& matrix,
                  std::vector<ProjectedCapsule>& out) {
  out.resize(body.flesh.size());
  const PixelScale camera(matrix);
  for (std::size_t i = 0; i < body.flesh.size(); ++i) {
    const FleshCapsule& flesh = body.flesh[i];
    const glm::dvec3 p_WA = PlaceOf(flesh.a, frames), p_WB = PlaceOf(flesh.b, frames);
    const double depth_a = camera.DepthOf(p_WA), depth_b = camera.DepthOf(p_WB);
    out[i].is_valid = depth_a > kNearest && depth_b > kNearest;
    if (!out[i].is_valid) continue;
    out[i].a = camera.PixelOf(p_WA);
    out[i].b = camera.PixelOf(p_WB);
    out[i].radius_a = flesh.radius_a * camera.focal_px() / depth_a;
    out[i].radius_b = flesh.radius_b * camera.focal_px() / depth_b;
  }
}

SilhouetteResidual DistanceTo(const ProjectedCapsule& capsule, const glm::dvec2& pixel) {
  const ConePoint nearest = NearestOnCone(capsule, pixel);
  const glm::dvec2 away = pixel - glm::mix(capsule.a, capsule.b, nearest.along);
  const glm::dvec2 normal = nearest.distance > 0 ? away / nearest.distance : glm::dvec2(0);
  const double t = nearest.along, s = 1 - t;
  return {nearest.signed_distance, 0, {-s * normal.x, -s * normal.y, -s, -t * normal.x, -t * normal.y, -t}, false};
}

void AppendResiduals(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                     const SilhouetteCostOptions& options, std::vector<SilhouetteResidual>& out) {
  if (silhouette.area == 0) return;
  AppendOutline(flesh, silhouette, out);
  AppendContainment(flesh, silhouette, options, out);
}

void OutlineDistances(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                      std::span<double> distances) {
  const std::vector<Bound> bounds = BoundsOf(flesh);
  for (std::size_t i = 0; i < silhouette.outline.size(); ++i) {
    NearestCapsule(flesh, bounds, silhouette.outline[i].pixel, distances[i]);
  }
}

void AppendContainment(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                       const SilhouetteCostOptions& options, std::vector<SilhouetteResidual>& out) {
  constexpr std::array<double, 4> kSamples = {0, 1.0 / 3, 2.0 / 3, 1};
  for (std::size_t i = 0; i < flesh.size(); ++i) {
    if (!flesh[i].is_valid) continue;
    for (const double t : kSamples) {
      const double radius = std::lerp(flesh[i].radius_a, flesh[i].radius_b, t);
      const DistanceAt at = DistanceAtPixel(silhouette, glm::mix(flesh[i].a, flesh[i].b, t));
      const double outside = at.distance + options.inside_share * radius;
      if (outside <= 0) continue;
      const double s = 1 - t, share = options.inside_share;
      out.push_back({outside,
                     static_cast<int>(i),
                     {s * at.gradient.x, s * at.gradient.y, s * share, t * at.gradient.x, t * at.gradient.y, t * share},
                     true});
    }
  }
}

Loss LossOf(const SilhouetteResidual& residual, const SilhouetteCostOptions& options) {
  const double reach = residual.is_inside ? options.inside_reach_px : options.outline_reach_px;
  const double counts = (residual.is_inside ? options.inside_weight : 1) / (options.sigma_px * options.sigma_px);
  const double square = residual.value * residual.value;
  const double share = 1 / (1 + square / (reach * reach));
  return {counts * square * share, counts * share * share};
}

}  // namespace etude
