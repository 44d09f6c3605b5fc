#include "engine/cameras/agreeing_views.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <numeric>
#include <optional>

namespace etude {
namespace {

/// How far a view is from showing what two others say, pixels; infinity when it cannot.
using DistanceOfView = std::vector<double>;

struct Consensus {
  std::vector<std::size_t> views;
  double weight = 0;
  double squares = std::numeric_limits<double>::infinity();  // their mean squared distance

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

// `distances_by(i, j)`: of all views from what the views i and j say, or nothing.
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

}  // namespace etude
