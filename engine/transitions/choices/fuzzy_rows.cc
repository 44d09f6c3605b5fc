#include "engine/transitions/choices/fuzzy_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etude {

FuzzyRows::FuzzyRows(std::span<const Grades> frames, const FeatureWeights& weights)
    : metric_(weights), blocks_(static_cast<std::size_t>(BlocksFor(frames.size()))) {
  for (std::size_t f = 0; f < frames.size(); ++f) {
    blocks_[f / kBlockLanes].Set(static_cast<int>(f % kBlockLanes), frames[f]);
  }
}

void FuzzyRows::Compute(const Grades& grades, std::span<double> distances) const {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < distances.size(); first += kBlockLanes) {
    const BlockResult block = SquaredDistances(metric_, grades, blocks_[first / kBlockLanes], kAll);
    const std::size_t count = std::min<std::size_t>(kBlockLanes, distances.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) distances[first + lane] = std::sqrt(block.squared[lane]);
  }
}

}  // namespace etude
