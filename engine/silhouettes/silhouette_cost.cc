#include "engine/silhouettes/silhouette_cost.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace etude {
namespace {

constexpr double kNearest = 0.05;  // metres in front of the camera; a capsule with a nearer end is not projected

struct ConePoint {
  double along = 0;     // position on the axis: 0 at a, 1 at b
  double distance = 0;  // distance from the pixel to the point at `along`, pixels
  double signed_distance = 0;
};

// Finds the nearest point of a round cone in two dimensions. Along the axis, the distance minus the radius is minimal
// where (x − along·length) / distance = −(radius_b − radius_a) / length; x is the pixel's coordinate along the axis.
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

void PrepareCones(const std::vector<ProjectedCapsule>& flesh, ConeColumns& cones) {
  cones.count = (flesh.size() + kConeLanes - 1) / kConeLanes * kConeLanes;
  assert(cones.count <= kMaxCones);
  for (std::size_t i = 0; i < cones.count; ++i) {
    std::array<double, kConeRows> cone = {0, 0, 0, 0, 1, 0, 1, -std::numeric_limits<double>::infinity(), 0, 0, 0};
    if (i < flesh.size() && flesh[i].is_valid) {
      const ProjectedCapsule& capsule = flesh[i];
      const glm::dvec2 axis = capsule.b - capsule.a;
      const double length2 = glm::dot(axis, axis), widens = capsule.radius_b - capsule.radius_a;
      const bool is_ball = length2 <= widens * widens;  // one end's circle contains the other's
      cone = {capsule.a.x,
              capsule.a.y,
              axis.x,
              axis.y,
              length2,
              widens,
              is_ball ? 1 : std::sqrt(length2 - widens * widens),
              capsule.radius_a,
              is_ball ? (widens > 0 ? 1.0 : 0.0) : -1.0,
              capsule.b.x,
              capsule.b.y};
    }
    for (std::size_t row = 0; row < kConeRows; ++row) cones.rows[row][i] = cone[row];
  }
}

PointColumns PointsOf(const OutlineColumns& columns) {
  return {columns.radius.size(),   columns.u.data(),        columns.v.data(),
          columns.centre_u.data(), columns.centre_v.data(), columns.radius.data()};
}

void AppendOutline(const SeenFlesh& flesh, const Silhouette& silhouette, std::vector<SilhouetteResidual>& out) {
  for (std::size_t i = 0; i < silhouette.outline.size(); ++i) {
    const int owner = static_cast<int>(flesh.owners[static_cast<std::size_t>(silhouette.columns.places[i])]);
    if (owner < 0) continue;
    SilhouetteResidual& residual =
        out.emplace_back(DistanceTo(flesh.capsules[static_cast<std::size_t>(owner)], silhouette.outline[i].pixel));
    residual.capsule = owner;
  }
}

// Positions along a capsule's axis (0 at a, 1 at b) at which the capsule must lie inside the silhouette.
constexpr std::array<double, SeenFlesh::kInsideSamples> kSamples = {0, 1.0 / 3, 2.0 / 3, 1};

DistanceAt DistanceAtSample(const Silhouette& silhouette, const ProjectedCapsule& capsule, std::size_t sample) {
  return DistanceAtPixel(silhouette, glm::mix(capsule.a, capsule.b, kSamples[sample]));
}

// Calls take(residual) for every containment residual. distance_at(capsule, sample) must return the silhouette's signed
// distance at that sample of the capsule's axis.
template <typename Distance, typename Take>
void ForEachContainment(const std::vector<ProjectedCapsule>& flesh, const SilhouetteCostOptions& options,
                        const Distance& distance_at, const Take& take) {
  for (std::size_t i = 0; i < flesh.size(); ++i) {
    if (!flesh[i].is_valid) continue;
    for (std::size_t sample = 0; sample < kSamples.size(); ++sample) {
      const double t = kSamples[sample];
      const double radius = std::lerp(flesh[i].radius_a, flesh[i].radius_b, t);
      const DistanceAt at = distance_at(i, sample);
      const double outside = at.distance + options.inside_share * radius;
      if (outside <= 0) continue;
      const double s = 1 - t, share = options.inside_share;
      take(SilhouetteResidual{
          outside,
          static_cast<int>(i),
          {s * at.gradient.x, s * at.gradient.y, s * share, t * at.gradient.x, t * at.gradient.y, t * share},
          true});
    }
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

void MeasureFlesh(const Silhouette& silhouette, SeenFlesh& flesh) {
  flesh.distances.assign(silhouette.columns.u.size(), std::numeric_limits<double>::infinity());
  flesh.owners.assign(flesh.distances.size(), -1);
  PrepareCones(flesh.capsules, flesh.cones);
  FindNearestCones(flesh.cones, PointsOf(silhouette.columns), flesh.distances.data(), flesh.owners.data());
  flesh.inside.resize(flesh.capsules.size());
  for (std::size_t i = 0; i < flesh.capsules.size() && silhouette.area > 0; ++i) {
    if (!flesh.capsules[i].is_valid) continue;
    for (std::size_t sample = 0; sample < kSamples.size(); ++sample) {
      flesh.inside[i][sample] = DistanceAtSample(silhouette, flesh.capsules[i], sample);
    }
  }
}

double SignedDistanceTo(const ProjectedCapsule& capsule, const glm::dvec2& pixel) {
  return NearestOnCone(capsule, pixel).signed_distance;
}

SilhouetteResidual DistanceTo(const ProjectedCapsule& capsule, const glm::dvec2& pixel) {
  const ConePoint nearest = NearestOnCone(capsule, pixel);
  const glm::dvec2 away = pixel - glm::mix(capsule.a, capsule.b, nearest.along);
  const glm::dvec2 normal = nearest.distance > 0 ? away / nearest.distance : glm::dvec2(0);
  const double t = nearest.along, s = 1 - t;
  return {nearest.signed_distance, 0, {-s * normal.x, -s * normal.y, -s, -t * normal.x, -t * normal.y, -t}, false};
}

void AppendResiduals(const SeenFlesh& flesh, const Silhouette& silhouette, const SilhouetteCostOptions& options,
                     std::vector<SilhouetteResidual>& out) {
  if (silhouette.area == 0) return;
  AppendOutline(flesh, silhouette, out);
  ForEachContainment(
      flesh.capsules, options, [&](std::size_t i, std::size_t sample) { return flesh.inside[i][sample]; },
      [&](const SilhouetteResidual& residual) { out.push_back(residual); });
}

void SumResiduals(const SeenFlesh& flesh, const Silhouette& silhouette, const SilhouetteCostOptions& options,
                  ResidualSums& out) {
  out.capsules.resize(flesh.capsules.size());
  if (silhouette.area == 0) {
    std::ranges::fill(out.capsules, ConeSums{});
    return;
  }
  // Sort the outline points by their nearest capsule; within a capsule they keep their order.
  const auto owner_of = [&](std::size_t point) {
    return static_cast<int>(flesh.owners[static_cast<std::size_t>(silhouette.columns.places[point])]);
  };
  std::array<std::size_t, kMaxCones + 1> ends{};
  const std::size_t count = silhouette.outline.size();
  for (std::size_t i = 0; i < count; ++i) ++ends[static_cast<std::size_t>(owner_of(i) + 1)];
  ends[0] = 0;  // points without a capsule are left out
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  out.u.resize(count + kBlockPoints);
  out.v.resize(count + kBlockPoints);
  for (std::size_t i = 0; i < count; ++i) {
    const int owner = owner_of(i);
    if (owner < 0) continue;
    const std::size_t at = ends[static_cast<std::size_t>(owner)]++;
    out.u[at] = silhouette.outline[i].pixel.x;
    out.v[at] = silhouette.outline[i].pixel.y;
  }
  // Sum the outline's residuals capsule by capsule, then add those of containment.
  std::size_t begin = 0;
  for (std::size_t i = 0; i < flesh.capsules.size(); begin = ends[i++]) {
    if (ends[i] == begin) {
      out.capsules[i] = {};
      continue;
    }
    SumConePoints(flesh.cones, i,
                  {ends[i] - begin, &out.u[begin], &out.v[begin], 1 / (options.sigma_px * options.sigma_px),
                   options.outline_reach_px * options.outline_reach_px},
                  out.capsules[i]);
  }
  ForEachContainment(
      flesh.capsules, options, [&](std::size_t i, std::size_t sample) { return flesh.inside[i][sample]; },
      [&](const SilhouetteResidual& residual) {
        ConeSums& sums = out.capsules[static_cast<std::size_t>(residual.capsule)];
        const double weight = LossOf(residual, options).weight, weighted_value = weight * residual.value;
        for (std::size_t row = 0; row < 6; ++row) {
          sums.gradient[row] += weighted_value * residual.slopes[row];
          const double weighted = weight * residual.slopes[row];
          for (std::size_t column = 0; column < 6; ++column) {
            sums.hessian[column][row] += weighted * residual.slopes[column];
          }
        }
      });
}

void AddLosses(const SeenFlesh& flesh, const Silhouette& silhouette, const SilhouetteCostOptions& options,
               double& sum) {
  if (silhouette.area == 0) return;
  // Compute the losses column by column, so that the loop can be vectorised; then add them in the outline's order.
  std::vector<double> losses(flesh.distances.size());
  const double counts = 1 / (options.sigma_px * options.sigma_px);
  const double reach2 = options.outline_reach_px * options.outline_reach_px;
  for (std::size_t i = 0; i < losses.size(); ++i) {
    const double square = flesh.distances[i] * flesh.distances[i];
    losses[i] = flesh.owners[i] >= 0 ? counts * square * (1 / (1 + square / reach2)) : 0;
  }
  double outline = sum;
  for (const int place : silhouette.columns.places) outline += losses[static_cast<std::size_t>(place)];
  sum = outline;
  ForEachContainment(
      flesh.capsules, options, [&](std::size_t i, std::size_t sample) { return flesh.inside[i][sample]; },
      [&](const SilhouetteResidual& residual) { sum += LossOf(residual, options).loss; });
}

void AddContainmentLosses(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                          const SilhouetteCostOptions& options, double& sum) {
  ForEachContainment(
      flesh, options, [&](std::size_t i, std::size_t sample) { return DistanceAtSample(silhouette, flesh[i], sample); },
      [&](const SilhouetteResidual& residual) { sum += LossOf(residual, options).loss; });
}

void OutlineDistances(const std::vector<ProjectedCapsule>& flesh, const Silhouette& silhouette,
                      std::span<double> distances) {
  std::vector<double> owners(distances.size());
  ConeColumns cones;
  PrepareCones(flesh, cones);
  FindNearestCones(cones, PointsOf(silhouette.columns), distances.data(), owners.data());
}

}  // namespace etude
