#include "engine/cameras/robust_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/cameras/agreeing_views.h"
#include "engine/cameras/likeliest_point.h"

namespace etude {
namespace {

double DistancePx(const Sighting& sighting, const glm::dvec3& p_WQ) {
  const auto pixel = Project(sighting.matrix, p_WQ);
  return pixel ? glm::distance(*pixel, sighting.pixel) : std::numeric_limits<double>::infinity();
}

/// Which of those that are sure of anything agree with each other.
std::vector<bool> AgreeingOf(std::span<const WeightedSighting> sightings, double outlier_px) {
  std::vector<Sighting> sure;
  std::vector<double> weights;
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!(sightings[i].weight > 0)) continue;
    sure.push_back(sightings[i].sighting);
    weights.push_back(sightings[i].weight);
    at.push_back(i);
  }
  std::vector<bool> agrees(sightings.size());
  for (const std::size_t view : AgreeingViews(sure, outlier_px, weights)) agrees[at[view]] = true;
  return agrees;
}

std::optional<glm::dvec3> PointOf(std::span<const WeightedSighting> sightings, const std::vector<bool>& agrees) {
  std::vector<InformedSighting> informed;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (agrees[i]) informed.push_back({sightings[i].sighting, glm::dmat2(sightings[i].weight)});
  }
  const auto point = TriangulateLikeliest(informed);
  return point ? std::optional(point->position) : std::nullopt;
}

}  // namespace

std::optional<RobustPoint> TriangulateRobustly(std::span<const WeightedSighting> sightings,
                                               const RobustOptions& options) {
  RobustPoint found{.agrees = AgreeingOf(sightings, options.outlier_px)};
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const auto point = PointOf(sightings, found.agrees);
    if (!point) return std::nullopt;
    found.position = *point;
    std::vector<bool> agrees;
    for (const WeightedSighting& s : sightings) {
      agrees.push_back(s.weight > 0 && DistancePx(s.sighting, found.position) <= options.outlier_px);
    }
    if (agrees == found.agrees) break;
    found.agrees = std::move(agrees);
  }
  if (std::ranges::count(found.agrees, true) < 2) return std::nullopt;
  double squares = 0, weights = 0;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!found.agrees[i]) continue;
    const double distance = DistancePx(sightings[i].sighting, found.position);
    squares += sightings[i].weight * distance * distance;
    weights += sightings[i].weight;
  }
  found.residual_px = std::sqrt(squares / weights);
  if (!std::isfinite(found.residual_px)) return std::nullopt;
  return found;
}

}  // namespace etude
