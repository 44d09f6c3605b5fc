#include "engine/cameras/robust_triangulation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace etude {

std::optional<PointEquations> PointEquationsAt(std::span<const InformedSighting> sightings, const glm::dvec3& p_WQ) {
  PointEquations sum;
  for (const InformedSighting& seen : sightings) {
    const auto pixel = Project(seen.sighting.matrix, p_WQ);
    if (!pixel) return std::nullopt;
    const auto& h = seen.sighting.matrix.h;
    const double depth = h[2][0] * p_WQ.x + h[2][1] * p_WQ.y + h[2][2] * p_WQ.z + h[2][3];
    glm::dmat3x2 gains;  // derivatives of u and v with respect to x, y, z (columns)
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 2; ++k) gains[axis][k] = (h[k][axis] - (*pixel)[k] * h[2][axis]) / depth;
    }
    const glm::dmat2x3 transposed = glm::transpose(gains);
    sum.information += transposed * seen.information * gains;
    sum.right += transposed * (seen.information * (seen.sighting.pixel - *pixel));
  }
  return sum;
}

std::optional<LikeliestPoint> TriangulateLikeliest(std::span<const InformedSighting> sightings) {
  std::vector<Sighting> plain;
  for (const InformedSighting& seen : sightings) plain.push_back(seen.sighting);
  const TriangulatedPoint linear = Triangulate(plain);
  if (linear.status != PointStatus::kOk) return std::nullopt;
  glm::dvec3 place = linear.position;
  constexpr int kSteps = 5;
  for (int i = 0; i < kSteps; ++i) {
    const auto sum = PointEquationsAt(sightings, place);
    if (!sum) return std::nullopt;
    place += glm::inverse(sum->information) * sum->right;
  }
  const auto sum = PointEquationsAt(sightings, place);
  if (!sum || !std::isfinite(glm::length(place)) || !(glm::determinant(sum->information) > 0)) return std::nullopt;
  return LikeliestPoint{place, sum->information};
}

namespace {

/// For each view: the distance between its sighting and the projection of a point, pixels; infinity if the view cannot
/// show the point.
using DistanceOfView = std::vector<double>;

struct Consensus {
  std::vector<std::size_t> views;
  double weight = 0;
  double squares = std::numeric_limits<double>::infinity();  // weighted mean squared distance over `views`, px²

  bool IsBetterThan(const Consensus& other) const {
    return weight != other.weight ? weight > other.weight : squares < other.squares;
  }
};

Consensus ConsensusOf(const DistanceOfView& distances, double tolerance_px, std::span<const double> weights) {
  Consensus consensus;
  double sum = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (!(distances[i] <= tolerance_px)) continue;
    const double weight = weights.empty() ? 1 : weights[i];
    consensus.views.push_back(i);
    consensus.weight += weight;
    sum += weight * distances[i] * distances[i];
  }
  if (!consensus.views.empty()) consensus.squares = sum / consensus.weight;
  return consensus;
}

// Returns the consensus with the largest weight over all pairs of views; all views if there are fewer than three or no
// pair has a consensus. `distances_by(i, j)` returns the distances of all views from the point of views i and j, or
// nullopt.
template <typename DistancesBy>
std::vector<std::size_t> LargestConsensus(std::size_t count, double tolerance_px, std::span<const double> weights,
                                          const DistancesBy& distances_by) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (count < 3) return all;
  Consensus best;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const std::optional<DistanceOfView> distances = distances_by(i, j);
      if (!distances) continue;
      const Consensus consensus = ConsensusOf(*distances, tolerance_px, weights);
      if (consensus.views.size() >= 2 && consensus.IsBetterThan(best)) best = consensus;
    }
  }
  return best.views.empty() ? all : best.views;
}

std::optional<DistanceOfView> DistancesFrom(std::span<const Sighting> sightings, std::size_t i, std::size_t j) {
  const std::array<Sighting, 2> pair = {sightings[i], sightings[j]};
  const TriangulatedPoint point = Triangulate(pair);
  if (point.status != PointStatus::kOk) return std::nullopt;
  DistanceOfView distances;
  for (const Sighting& sighting : sightings) {
    const auto pixel = Project(sighting.matrix, point.position);
    distances.push_back(pixel ? glm::distance(*pixel, sighting.pixel) : std::numeric_limits<double>::infinity());
  }
  return distances;
}

double DistancePx(const Sighting& sighting, const glm::dvec3& p_WQ) {
  const auto pixel = Project(sighting.matrix, p_WQ);
  return pixel ? glm::distance(*pixel, sighting.pixel) : std::numeric_limits<double>::infinity();
}

/// Returns one flag per sighting: true if the sighting has a positive weight and agrees with the other sightings.
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

// Returns the most likely position from the agreeing sightings.
std::optional<glm::dvec3> PointOf(std::span<const WeightedSighting> sightings, const std::vector<bool>& agrees) {
  std::vector<InformedSighting> informed;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (agrees[i]) informed.push_back({sightings[i].sighting, glm::dmat2(sightings[i].weight)});
  }
  const auto point = TriangulateLikeliest(informed);
  return point ? std::optional(point->position) : std::nullopt;
}

}  // namespace

std::vector<std::size_t> AgreeingViews(std::span<const Sighting> sightings, double tolerance_px,
                                       std::span<const double> weights) {
  assert(weights.empty() || weights.size() == sightings.size());
  return LargestConsensus(sightings.size(), tolerance_px, weights,
                          [&](std::size_t i, std::size_t j) { return DistancesFrom(sightings, i, j); });
}

std::vector<std::size_t> AgreeingViews(std::span<const LimbSighting> sightings, double tolerance_px) {
  std::vector<Sighting> begins, ends;
  for (const LimbSighting& sighting : sightings) {
    begins.push_back({sighting.matrix, sighting.stroke.a});
    ends.push_back({sighting.matrix, sighting.stroke.b});
  }
  return LargestConsensus(sightings.size(), tolerance_px, {},
                          [&](std::size_t i, std::size_t j) -> std::optional<DistanceOfView> {
                            auto distances = DistancesFrom(begins, i, j);
                            const auto others = DistancesFrom(ends, i, j);
                            if (!distances || !others) return std::nullopt;
                            for (std::size_t k = 0; k < distances->size(); ++k) {
                              (*distances)[k] = std::max((*distances)[k], (*others)[k]);
                            }
                            return distances;
                          });
}

std::optional<RobustPoint> TriangulateRobustly(std::span<const WeightedSighting> sightings,
                                               const RobustOptions& options) {
  RobustPoint found{.agrees = AgreeingOf(sightings, options.outlier_px)};
  // Alternate between the position and the set of sightings within the threshold. Each step lowers Σ w · min(d², T²),
  // where T is the threshold, so the two settle; the last round keeps the set whose position it has computed.
  constexpr int kMaxRounds = 20;
  for (int round = 0; round < kMaxRounds; ++round) {
    const auto point = PointOf(sightings, found.agrees);
    if (!point) return std::nullopt;
    found.position = *point;
    if (round + 1 == kMaxRounds) break;
    std::vector<bool> agrees;
    for (const WeightedSighting& s : sightings) {
      agrees.push_back(s.weight > 0 && DistancePx(s.sighting, found.position) <= options.outlier_px);
    }
    if (agrees == found.agrees) break;
    found.agrees = std::move(agrees);
  }
  if (std::ranges::count(found.agrees, true) < 2) return std::nullopt;
  // Compute the residual over the agreeing sightings.
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
