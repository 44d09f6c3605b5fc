#include "engine/switching/choices/fuzzy_rows.h"

#include <algorithm>

namespace etude {

FuzzyRows::FuzzyRows(std::span<const Grades> frames, const FeatureWeights& weights)
    : blocks_((frames.size() + kLanes - 1) / kLanes), weights_(weights) {
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (std::size_t t = 0; t < kTermCount; ++t) blocks_[f / kLanes][t][f % kLanes] = frames[f][t];
  }
}

void FuzzyRows::Compute(const Grades& grades, std::span<double> squares) const {
  using Lanes = std::array<double, kLanes>;
  std::array<std::size_t, kFeatureCount + 1> ends{};
  for (std::size_t k = 0; k < kFeatureCount; ++k) ends[k + 1] = ends[k] + TermsOf(AllFeatures()[k]).size();
  for (std::size_t first = 0; first < squares.size(); first += kLanes) {
    const Block& block = blocks_[first / kLanes];
    Lanes sums{};
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      Lanes gaps{};
      for (std::size_t t = ends[k]; t < ends[k + 1]; ++t) {
#pragma GCC unroll 4
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          const double gap = grades[t] - block[t][lane];
          gaps[lane] += gap * gap;
        }
      }
#pragma GCC unroll 4
      for (std::size_t lane = 0; lane < kLanes; ++lane) sums[lane] += weights_[k] * gaps[lane];
    }
    const std::size_t count = std::min(kLanes, squares.size() - first);
    std::copy_n(sums.begin(), count, squares.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace etude
