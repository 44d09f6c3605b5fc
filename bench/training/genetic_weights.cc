#include "bench/training/genetic_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/training/match_score.h"

namespace etude {

std::optional<FeatureWeights> WeightsOfGenes(std::span<const double> genes) {
  const double sum = std::inner_product(genes.begin(), genes.end(), genes.begin(), 0.0);
  if (sum <= 0) return std::nullopt;
  FeatureWeights weights;
  for (std::size_t k = 0; k < kFeatureCount; ++k) weights[k] = genes[k] * genes[k] * (kWeightSum / sum);
  return weights;
}

Genome GenesOf(const FeatureWeights& weights) {
  const double largest = *std::max_element(weights.begin(), weights.end());
  Genome genes;
  for (double weight : weights) genes.push_back(std::sqrt(weight / largest));
  return genes;
}

WeightFit FitWeightsGenetically(std::span<const LabelledPair> pairs, const FeatureWeights& start,
                                const GeneticOptions& options) {
  WeightFit fit;
  fit.weights = start;
  fit.pairs = static_cast<int>(pairs.size());
  fit.close_pairs = static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [](auto& pair) { return pair.close; }));
  if (fit.close_pairs == 0 || fit.close_pairs == fit.pairs) return fit;

  const PairTable table(pairs);
  const auto score = [&table](std::span<const double> genes) {
    const auto weights = WeightsOfGenes(genes);
    return weights ? table.SoftF1(*weights, kPaperThreshold, kFitnessRamp) : 0;
  };
  const Genome ancestors[] = {GenesOf(start)};
  const GeneticResult result = SearchGenetically(score, ancestors, options);
  fit.iterations = result.generations;
  fit.status = result.score > 0 ? WeightFitStatus::kFitted : WeightFitStatus::kNothingCounts;
  if (fit.status == WeightFitStatus::kFitted) fit.weights = *WeightsOfGenes(result.best);
  return fit;
}

}  // namespace etude
