#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A genome: genes in [0, 1].
using Genome = std::vector<double>;

/// How long and how widely to search. The defaults are where more of either no longer changed what was learnt.
struct GeneticOptions {
  int population = 40;
  int generations = 60;
  std::uint64_t seed = 1;
  /// Told after every generation: how many there have been, and the best score so far.
  std::function<void(int generation, double best)> progress = {};
};

struct GeneticResult {
  Genome best;
  double score = 0;
  int generations = 0;
};

/// Loads the library that searches, Pagmo, which stands in a module beside the program. Fails where the module is missing.
Result<void> LoadGeneticSearch();

/// A genetic algorithm (Holland; Pagmo's `sga`: tournaments of 2, binomial crossover, Gaussian mutation, the best of
/// parents and children survive). Looks for the genome of the highest `score`, which must be finite and depend on
/// the genome alone. The first population is `ancestors` (at least one, all of the same length), then random ones; so
/// the answer scores no less than any ancestor. The same seed gives the same answer.
/// Throws std::runtime_error where LoadGeneticSearch fails.
GeneticResult SearchGenetically(const std::function<double(std::span<const double>)>& score,
                                std::span<const Genome> ancestors, const GeneticOptions& options = {});

/// The module's one function, to which its symbol `etude_pagmo_evolve` points: the search, by seeds of its random genomes
/// and of its algorithm.
using PagmoEvolve = void(const std::function<double(std::span<const double>)>& score,
                         std::span<const Genome> ancestors, const GeneticOptions& options, unsigned population_seed,
                         unsigned algorithm_seed, GeneticResult& result);

}  // namespace etude
