#include "bench/training/adaptive_weights.h"

#include <algorithm>

namespace etude {

AdaptiveWeights::AdaptiveWeights(const TrainingClips& training) : training_(training) {}

TrainingClip AdaptiveWeights::ClipAt(std::size_t index) const {
  return {&training_.library.motions[index], &training_.library.tagged[index]};
}

const WeightFit& AdaptiveWeights::Without(const std::string& judged_a, const std::string& judged_b) {
  const auto key = std::minmax(judged_a, judged_b);
  if (const auto known = fits_.find(key); known != fits_.end()) return known->second;

  std::vector<std::size_t> allowed;
  for (std::size_t i = 0; i < training_.identities.size(); ++i) {
    const std::string& identity = training_.identities[i];
    if (identity != judged_a && identity != judged_b) allowed.push_back(i);
  }
  std::vector<LabelledPair> examples;
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    for (std::size_t j = i + 1; j < allowed.size(); ++j) {
      auto [block, is_new] = pairs_.try_emplace({allowed[i], allowed[j]});
      if (is_new) block->second = LabelPairs(ClipAt(allowed[i]), ClipAt(allowed[j]));
      examples.insert(examples.end(), block->second.begin(), block->second.end());
    }
  }
  return fits_.emplace(key, FitWeights(examples)).first->second;
}

}  // namespace etude
