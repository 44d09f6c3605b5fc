#include "engine/cameras/robust_triangulation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace etude {
namespace {

double DistancePx(const Sighting& sighting, const glm::dvec3& p_WQ) {
  const auto pixel = Project(sighting.matrix, p_WQ);
  return pixel ? glm::distance(*pixel, sighting.pixel) : std::numeric_limits<double>::infinity();
}

/// Σ w · max(0, 1 − d²/τ²).
double SupportOf(std::span<const WeightedSighting> sightings, const glm::dvec3& p_WQ, double outlier_px) {
  double support = 0;
  for (const WeightedSighting& s : sightings) {
    const double share = DistancePx(s.sighting, p_WQ) / outlier_px;
    if (s.weight > 0) support += s.weight * std::max(0.0, 1 - share * share);
  }
  return support;
}

/// One step towards the least Σ w d² over those that agree; the same point when there is none.
glm::dvec3 Step(std::span<const WeightedSighting> sightings, const std::vector<bool>& agrees, const glm::dvec3& p_WQ) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!agrees[i]) continue;
    const auto& h = sightings[i].sighting.matrix.h;
    double p[3];
    for (int row = 0; row < 3; ++row) p[row] = h[row][0] * p_WQ.x + h[row][1] * p_WQ.y + h[row][2] * p_WQ.z + h[row][3];
    for (int k = 0; k < 2; ++k) {
      const double shown = p[k] / p[2];
      const Eigen::Vector3d slope((h[k][0] - shown * h[2][0]) / p[2], (h[k][1] - shown * h[2][1]) / p[2],
                                  (h[k][2] - shown * h[2][2]) / p[2]);
      normal += sightings[i].weight * slope * slope.transpose();
      gradient += sightings[i].weight * (sightings[i].sighting.pixel[k] - shown) * slope;
    }
  }
  const Eigen::Vector3d step = normal.ldlt().solve(gradient);
  return step.allFinite() ? p_WQ + glm::dvec3(step[0], step[1], step[2]) : p_WQ;
}

}  // namespace

std::optional<RobustPoint> TriangulateRobustly(std::span<const WeightedSighting> sightings,
                                               const RobustOptions& options) {
  std::optional<glm::dvec3> best;
  double most_support = 0;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    for (std::size_t j = i + 1; j < sightings.size(); ++j) {
      if (!(sightings[i].weight > 0) || !(sightings[j].weight > 0)) continue;
      const std::array pair = {sightings[i].sighting, sightings[j].sighting};
      const TriangulatedPoint point = Triangulate(pair);
      if (point.status != PointStatus::kOk) continue;
      const double support = SupportOf(sightings, point.position, options.outlier_px);
      if (support > most_support) {
        best = point.position;
        most_support = support;
      }
    }
  }
  if (!best) return std::nullopt;
  RobustPoint found{.position = *best};
  constexpr int kRounds = 3, kSteps = 5;
  for (int round = 0; round < kRounds; ++round) {
    found.agrees.clear();
    for (const WeightedSighting& s : sightings) {
      found.agrees.push_back(s.weight > 0 && DistancePx(s.sighting, found.position) <= options.outlier_px);
    }
    if (std::ranges::count(found.agrees, true) < 2) return std::nullopt;
    for (int step = 0; step < kSteps; ++step) found.position = Step(sightings, found.agrees, found.position);
  }
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
