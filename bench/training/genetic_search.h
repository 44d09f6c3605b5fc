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

/// A genome. Its genes are numbers in [0, 1].
using Genome = std::vector<double>;

/// The size of the search. Larger values than the defaults did not change the results.
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

/// Loads the module that contains Pagmo. The module is next to the program. Fails if the module is missing.
Result<void> LoadGeneticSearch();

/// Searches for the genome with the highest `score` with a genetic algorithm (Holland; Pagmo's `sga`: tournaments of 2,
/// binomial crossover, Gaussian mutation, the best of parents and children survive). `score` must be finite and depend
/// on the genome alone. The first population is `ancestors` (at least one, all of the same length), filled up with
/// random genomes. The result therefore scores no less than any ancestor. The same seed gives the same result. Throws
/// std::runtime_error if LoadGeneticSearch fails.
GeneticResult SearchGenetically(const std::function<double(std::span<const double>)>& score,
                                std::span<const Genome> ancestors, const GeneticOptions& options = {});

/// The type of the module's only function, which performs the search. The module's symbol `etude_pagmo_evolve` points
/// to this function. The function also receives the seeds of the random genomes and of the algorithm.
using PagmoEvolve = void(const std::function<double(std::span<const double>)>& score, std::span<const Genome> ancestors,
                         const GeneticOptions& options, unsigned population_seed, unsigned algorithm_seed,
                         GeneticResult& result);

/// The half-width of the ramp of PairTable::SoftF1, as a share of d² = 0.4². On the ramp, a pair counts as partly
/// matched. There are few close pairs, so F1 without a ramp jumps with every single pair. A search without a ramp would
/// overfit these pairs and do worse on other clips.
constexpr double kFitnessRamp = 0.5;

/// Fits the `genetic` weights (paper A leaves them to future work; the method is Etude's): the weights S ≥ 0 with sum 8
/// for which "d < 0.4" best separates the close pairs, measured by soft F1. The first ancestor is `start`, so the
/// result is no worse than `start` on the training pairs. `iterations` counts generations. The status is kOneClassOnly
/// if all pairs are close or none is, kNothingCounts if the best score is 0, and otherwise kFitted. Unless it is
/// kFitted, the weights are `start`.
WeightFit FitWeightsGenetically(std::span<const LabelledPair> pairs, const FeatureWeights& start,
                                const GeneticOptions& options = {});

/// Returns the weights for genes in [0, 1]: proportional to the genes' squares, with sum 8. A gene stands for √S, the
/// factor by which paper A's equation 1 scales a difference of grades; weights near zero are therefore frequent among
/// random genes. Nullopt if all genes are zero.
std::optional<FeatureWeights> WeightsOfGenes(std::span<const double> genes);
/// Returns the genes of these weights. At least one weight must be above zero.
Genome GenesOf(const FeatureWeights& weights);

/// The largest distance by which a breakpoint is moved, as a share of its feature's universe.
constexpr double kBreakpointReach = 0.2;

/// Returns the number of genes of the memberships. There is one gene per breakpoint of the triangular and trapezoidal
/// shapes inside the universe. Breakpoints at the ends of the universe are fixed, so that a shape that is flat up to an
/// end (a shoulder) stays flat there. Left and right limbs share their genes. Gaussian and singleton shapes are fixed.
std::size_t CountMembershipGenes(const Memberships& start);

/// Returns the memberships for genes in [0, 1]. A breakpoint of `start` with a gene is moved by (2 gene − 1) ·
/// kBreakpointReach · (width of the universe), at most to an end of the universe. Each shape's breakpoints are then
/// sorted again. Genes of ½ give `start`.
Memberships MembershipsOfGenes(const Memberships& start, std::span<const double> genes);

}  // namespace etude
