#include "bench/training/learnt_weights.h"

#include <algorithm>
#include <cassert>

#include "bench/training/genetic_search.h"
#include "engine/base/named.h"

namespace etude {
namespace {

constexpr Named<WeightSource> kSources[] = {
    {"fixed", WeightSource::kFixed}, {"adaptive", WeightSource::kAdaptive}, {"genetic", WeightSource::kGenetic}};

}  // namespace

std::vector<std::string> WeightSourceNames() { return NamesOf(kSources); }

WeightSource FindWeightSource(std::string_view name) { return ValueNamed(kSources, name); }

LearntWeights::LearntWeights(TrainingClips training, const FuzzySystem& system)
    : training_(std::move(training)), system_(system) {}

const FeatureWeights& LearntWeights::For(WeightSource source, const std::string& judged_a,
                                         const std::string& judged_b) {
  return source == WeightSource::kFixed ? system_.weights : FitOf(source, judged_a, judged_b).weights;
}

const WeightFit& LearntWeights::FitOf(WeightSource source, const std::string& judged_a, const std::string& judged_b) {
  assert(source != WeightSource::kFixed);
  const auto [first, second] = std::minmax(judged_a, judged_b);
  const std::tuple key(source, first, second);
  if (const auto known = fits_.find(key); known != fits_.end()) return known->second;

  const std::vector<LabelledPair> pairs = PairsWithout(judged_a, judged_b);
  WeightFit fit = source == WeightSource::kAdaptive ? FitWeights(pairs) : FitWeightsGenetically(pairs, system_.weights);
  if (fit.status != WeightFitStatus::kFitted) fit.weights = system_.weights;
  return fits_.emplace(key, fit).first->second;
}

const std::vector<LabelledPair>& LearntWeights::PairsOf(std::size_t clip_a, std::size_t clip_b) {
  auto [entry, is_new] = pairs_.try_emplace({clip_a, clip_b});
  if (is_new) entry->second = LabelPairs(training_.frames[clip_a], training_.frames[clip_b], system_.memberships);
  return entry->second;
}

std::vector<LabelledPair> LearntWeights::PairsWithout(const std::string& judged_a, const std::string& judged_b) {
  const auto is_judged = [&](std::size_t clip) {
    return training_.identities[clip] == judged_a || training_.identities[clip] == judged_b;
  };
  std::vector<LabelledPair> all;
  for (std::size_t i = 0; i < training_.identities.size(); ++i) {
    for (std::size_t j = i + 1; j < training_.identities.size() && !is_judged(i); ++j) {
      if (is_judged(j)) continue;
      const std::vector<LabelledPair>& pairs = PairsOf(i, j);
      all.insert(all.end(), pairs.begin(), pairs.end());
    }
  }
  return all;
}

}  // namespace etude
