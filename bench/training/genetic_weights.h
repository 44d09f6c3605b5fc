#pragma once

#include <optional>
#include <span>

#include "bench/training/genetic_search.h"
#include "engine/fuzzy/weights.h"

namespace etude {

/// Within which share of d² = 0.4² the genetic algorithms take pairs for let through in part (PairTable::SoftF1). Close
/// pairs are so few that F1 itself moves in steps of single pairs: a search by it learns those by heart, and does worse
/// on other clips.
constexpr double kFitnessRamp = 0.5;

/// The `genetic` weights (paper A's future work; how is ours): the S ≥ 0 of sum 8 by which "d < 0.4" tells the close
/// pairs best, by their soft F1. The first ancestor is `start`, so that what is learnt does no worse on what it saw.
/// Status as of FitWeights, `iterations` counts generations; unless kFitted, the weights are `start`.
WeightFit FitWeightsGenetically(std::span<const LabelledPair> pairs, const FeatureWeights& start,
                                const GeneticOptions& options = {});

/// The weights that genes in [0, 1] stand for: their squares' proportions, with sum 8. A gene is a √S, by which
/// equation 1 stretches a difference of grades; so weights near zero are found, too. Nothing when all genes are zero.
std::optional<FeatureWeights> WeightsOfGenes(std::span<const double> genes);
/// The genes of weights of which one is above zero.
Genome GenesOf(const FeatureWeights& weights);

}  // namespace etude
