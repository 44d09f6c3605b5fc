#include "bench/training/tuning.h"

#include <algorithm>

#include "bench/statistics/curves/curves.h"

namespace etude {
namespace {

FuzzySystem WithWeights(const FuzzySystem& start, const FeatureWeights& weights) {
  FuzzySystem system = start;
  system.weights = weights;
  return system;
}

/// Returns the fuzzy system for a genome: the genes of the weights, followed by the genes of the memberships. Nullopt
/// if all weights would be zero.
std::optional<FuzzySystem> SystemOfGenes(const FuzzySystem& start, std::span<const double> genes) {
  const auto weights = WeightsOfGenes(genes.first(kFeatureCount));
  if (!weights) return std::nullopt;
  FuzzySystem system = WithWeights(start, *weights);
  system.memberships = MembershipsOfGenes(start.memberships, genes.subspan(kFeatureCount));
  return system;
}

void TuneMemberships(ClipFrames clips, std::vector<LabelledPair> pairs, const GeneticOptions& genetic,
                     TunedSystem& tuned) {
  const FuzzySystem start = tuned.system;
  Genome unchanged = GenesOf(start.weights);
  unchanged.resize(kFeatureCount + CountMembershipGenes(start.memberships), 0.5);
  const auto score = [&](std::span<const double> genes) {
    const auto system = SystemOfGenes(start, genes);
    if (!system) return 0.0;
    UpdateGrades(clips, system->memberships, pairs);
    return PairTable(pairs).SoftF1(system->weights, kPaperThreshold, kFitnessRamp);
  };
  const GeneticResult result = SearchGenetically(score, {&unchanged, 1}, genetic);
  tuned.generations = result.generations;
  tuned.status = result.score > 0 ? WeightFitStatus::kFitted : WeightFitStatus::kNothingCounts;
  if (tuned.status == WeightFitStatus::kFitted) tuned.system = *SystemOfGenes(start, result.best);
}

}  // namespace

TunedSystem TuneSystem(ClipFrames clips, Tuning tuning, const GeneticOptions& genetic) {
  TunedSystem tuned;
  const std::vector<LabelledPair> pairs = LabelPairsAcross(clips, tuned.system.memberships);
  tuned.pairs = static_cast<int>(pairs.size());
  tuned.close_pairs =
      static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [](auto& pair) { return pair.close; }));
  if (tuned.close_pairs == 0 || tuned.close_pairs == tuned.pairs) return tuned;
  if (tuning == Tuning::kGeneticMemberships) {
    TuneMemberships(clips, pairs, genetic, tuned);
    return tuned;
  }
  const WeightFit fit =
      tuning == Tuning::kAdaptive ? FitWeights(pairs) : FitWeightsGenetically(pairs, tuned.system.weights, genetic);
  tuned.status = fit.status;
  tuned.generations = fit.iterations;
  if (fit.status == WeightFitStatus::kFitted) tuned.system = WithWeights(tuned.system, fit.weights);
  return tuned;
}

SystemScore ScoreSystem(ClipFrames clips, const FuzzySystem& system) {
  const std::vector<LabelledPair> pairs = LabelPairsAcross(clips, system.memberships);
  std::vector<JudgedEvent> events;
  for (const LabelledPair& pair : pairs) {
    double squared = 0;
    for (std::size_t k = 0; k < kFeatureCount; ++k) squared += system.weights[k] * pair.squared_gaps[k];
    events.push_back({.is_right = pair.close, .called_right = false, .score = -squared});
  }
  return {PairTable(pairs).Score(system.weights), RocAuc(events)};
}

}  // namespace etude
