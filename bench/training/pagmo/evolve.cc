#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "bench/training/genetic_search.h"

namespace etude {
namespace {

constexpr double kCrossover = 0.9;
constexpr double kSpreadIndex = 1;      // parameter of a crossover operator that is not used
constexpr double kMutation = 0.2;       // probability of mutation, per gene
constexpr double kMutationWidth = 0.1;  // standard deviation of a mutation
constexpr unsigned kTournament = 2;

/// The problem that Pagmo minimises: the negative score, as a function of genes in [0, 1].
struct Problem {
  const std::function<double(std::span<const double>)>* score = nullptr;
  std::size_t genes = 0;

  pagmo::vector_double fitness(const pagmo::vector_double& genome) const { return {-(*score)(genome)}; }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(genes, 0.0), pagmo::vector_double(genes, 1.0)};
  }
};

void Evolve(const std::function<double(std::span<const double>)>& score, std::span<const Genome> ancestors,
            const GeneticOptions& options, unsigned population_seed, unsigned algorithm_seed, GeneticResult& result) {
  pagmo::population population(pagmo::problem(Problem{&score, ancestors.front().size()}), 0u, population_seed);
  for (const Genome& ancestor : ancestors) population.push_back(ancestor);
  while (population.size() < static_cast<std::size_t>(options.population))
    population.push_back(population.random_decision_vector());

  // Each call runs one generation, so that progress can be reported. The algorithm keeps its random state between
  // calls.
  const pagmo::algorithm algorithm(pagmo::sga(1u, kCrossover, kSpreadIndex, kMutation, kMutationWidth, kTournament,
                                              "binomial", "gaussian", "tournament", algorithm_seed));
  for (int generation = 1; generation <= options.generations; ++generation) {
    population = algorithm.evolve(population);
    if (options.progress) options.progress(generation, -population.champion_f()[0]);
  }
  result = {population.champion_x(), -population.champion_f()[0], options.generations};
}

}  // namespace
}  // namespace etude

extern "C" __attribute__((visibility("default"))) etude::PagmoEvolve* const etude_pagmo_evolve = &etude::Evolve;
