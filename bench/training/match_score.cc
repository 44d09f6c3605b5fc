#include "bench/training/match_score.h"

#include <algorithm>
#include <array>

namespace etude {

PairTable::PairTable(std::span<const LabelledPair> pairs) {
  blocks_.resize((pairs.size() + kBlock - 1) / kBlock);  // all zeros
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Block& block = blocks_[i / kBlock];
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      block.squared_gaps[k][i % kBlock] = static_cast<float>(pairs[i].squared_gaps[k]);
    }
    block.used[i % kBlock] = 1;
    block.close[i % kBlock] = pairs[i].close;
    close_count_ += pairs[i].close;
  }
}

/// d² of every pair of the block.
void PairTable::AddUp(const Block& block, const FeatureWeights& weights, float (&squared)[kBlock]) {
  std::array<float, kFeatureCount> factors;
  for (std::size_t k = 0; k < kFeatureCount; ++k) factors[k] = static_cast<float>(weights[k]);
  // So many at a time that their sums stay in registers.
  constexpr int kStep = 16;
  for (int first = 0; first < kBlock; first += kStep) {
    std::array<float, kStep> sums{};
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
#pragma GCC unroll 16
      for (int i = 0; i < kStep; ++i) sums[i] += factors[k] * block.squared_gaps[k][first + i];
    }
    std::ranges::copy(sums, squared + first);
  }
}

MatchScore PairTable::Score(const FeatureWeights& weights, double threshold) const {
  const float limit = static_cast<float>(threshold * threshold);
  MatchScore score{.close = close_count_};
  for (const Block& block : blocks_) {
    float squared[kBlock];
    AddUp(block, weights, squared);
    for (int i = 0; i < kBlock; ++i) {
      const int matched = squared[i] < limit;
      score.matched += matched & block.used[i];
      score.close_matched += matched & block.close[i];
    }
  }
  return score;
}

double PairTable::SoftF1(const FeatureWeights& weights, double threshold, double ramp) const {
  const double squared_threshold = threshold * threshold;
  const float far = static_cast<float>(squared_threshold * (1 + ramp));
  const float slope = static_cast<float>(0.5 / (squared_threshold * ramp));
  // Lane by lane, so that the compiler may add several at once without changing their order.
  float matched[kBlock] = {}, close_matched[kBlock] = {};
  for (const Block& block : blocks_) {
    float squared[kBlock];
    AddUp(block, weights, squared);
    for (int i = 0; i < kBlock; ++i) {
      const float share = std::min(std::max((far - squared[i]) * slope, 0.0f), 1.0f);
      matched[i] += share * static_cast<float>(block.used[i]);
      close_matched[i] += share * static_cast<float>(block.close[i]);
    }
  }
  double all = 0, both = 0;
  for (int i = 0; i < kBlock; ++i) {
    all += matched[i];
    both += close_matched[i];
  }
  return both > 0 ? 2 * both / (all + close_count_) : 0;
}

}  // namespace etude
