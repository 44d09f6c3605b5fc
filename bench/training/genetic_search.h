#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/fuzzy/membership.h"
#include "engine/fuzzy/weights.h"

namespace etude {

/// A genome: genes in [0, 1].
using Genome = std::vector<double>;

/// The length and width of the search. At the defaults, more of either no longer changed what was learnt.
struct GeneticOptions {
  int population = 40;
  int generations = 60;
  std::uint64_t seed = 1;
  /// Called after every generation with the number of generations and the best score so far.
  std::function<void(int generation, double best)> progress = {};
};

struct GeneticResult {
  Genome best;
  double score = 0;
  int generations = 0;
};

/// Loads the library that searches, Pagmo, which stands in a module beside the program. Fails where the module is missing.
Result<void> LoadGeneticSearch();

/// Searches by a genetic algorithm (Holland; Pagmo's `sga`: tournaments of 2, binomial crossover, Gaussian mutation,
/// the best of parents and children survive). It looks for the genome of the highest `score`, which must be finite and
/// depend on the genome alone. The first population is `ancestors` (at least one, all of the same length), then random
/// ones; so the answer scores no less than any ancestor. The same seed gives the same answer.
/// Throws std::runtime_error where LoadGeneticSearch fails.
GeneticResult SearchGenetically(const std::function<double(std::span<const double>)>& score,
                                std::span<const Genome> ancestors, const GeneticOptions& options = {});

/// The module's one function, to which its symbol `etude_pagmo_evolve` points: the search, by seeds of its random genomes
/// and of its algorithm.
using PagmoEvolve = void(const std::function<double(std::span<const double>)>& score,
                         std::span<const Genome> ancestors, const GeneticOptions& options, unsigned population_seed,
                         unsigned algorithm_seed, GeneticResult& result);

/// The share of d² = 0.4² within which the genetic algorithms count a pair as let through in part (PairTable::SoftF1).
/// Close pairs are so few that F1 itself moves in steps of single pairs: a search by it learns those by heart, and does
/// worse on other clips.
constexpr double kFitnessRamp = 0.5;

/// Fits the `genetic` weights (paper A's future work; how is ours): the S ≥ 0 of sum 8 by which "d < 0.4" tells the
/// close pairs best, by their soft F1. The first ancestor is `start`, so that what is learnt does no worse on what it
/// saw. Status as of FitWeights, `iterations` counts generations; unless kFitted, the weights are `start`.
WeightFit FitWeightsGenetically(std::span<const LabelledPair> pairs, const FeatureWeights& start,
                                const GeneticOptions& options = {});

/// Returns the weights that genes in [0, 1] stand for: their squares' proportions, with sum 8. A gene is a √S, by which
/// equation 1 stretches a difference of grades; so weights near zero are found, too. Nothing when all genes are zero.
std::optional<FeatureWeights> WeightsOfGenes(std::span<const double> genes);
/// Returns the genes of weights of which at least one is above zero.
Genome GenesOf(const FeatureWeights& weights);

/// The largest move of a breakpoint, as a share of its feature's universe.
constexpr double kBreakpointReach = 0.2;

/// Returns the number of genes of the memberships: one per breakpoint within the universe of the triangular and
/// trapezoidal shapes. Breakpoints at its ends stay there, so that shoulders stay shoulders; left and right limbs share
/// theirs; Gaussian and singleton shapes stay as they are.
std::size_t CountMembershipGenes(const Memberships& start);

/// Returns the memberships that genes in [0, 1] stand for: every breakpoint of `start` moved by (2 gene − 1) reaches,
/// and each shape's put back into rising order. All genes ½ is `start`.
Memberships MembershipsOfGenes(const Memberships& start, std::span<const double> genes);

}  // namespace etude
