#include "bench/training/genetic_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "bench/training/training_pairs.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr double kCrossover = 0.9;
constexpr double kSpreadIndex = 1;      // of a crossover that is not used
constexpr double kMutation = 0.2;       // the chance of a gene
constexpr double kMutationWidth = 0.1;  // standard deviation
constexpr unsigned kTournament = 2;

/// The problem that Pagmo minimises.
struct Problem {
  const std::function<double(std::span<const double>)>* score = nullptr;
  std::size_t genes = 0;

  pagmo::vector_double fitness(const pagmo::vector_double& genome) const { return {-(*score)(genome)}; }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(genes, 0.0), pagmo::vector_double(genes, 1.0)};
  }
};

using enum Feature;
/// The tuned features, each with the limb's other side, which is tuned along with it.
constexpr Feature kTuned[][2] = {{kRH, kLH},       {kRHE, kLHE}, {kPosture, kPosture},
                                 {kTrunk, kTrunk}, {kRF, kLF},   {kRFK, kLFK}};

/// Returns the breakpoints of a shape, rising; Gaussian and singleton shapes have none.
std::vector<double> BreakpointsOf(const Shape& shape) {
  if (const auto* triangle = std::get_if<Triangular>(&shape)) return {triangle->left, triangle->peak, triangle->right};
  if (const auto* top = std::get_if<Trapezoidal>(&shape)) {
    return {top->left, top->left_top, top->right_top, top->right};
  }
  return {};
}

Shape WithBreakpoints(const Shape& shape, const std::vector<double>& at) {
  if (at.size() == 3) return Triangular{at[0], at[1], at[2]};
  if (at.size() == 4) return Trapezoidal{at[0], at[1], at[2], at[3]};
  return shape;
}

bool IsWithin(double breakpoint, const Universe& universe) {
  return breakpoint > universe.low && breakpoint < universe.high;
}

}  // namespace

GeneticResult SearchGenetically(const std::function<double(std::span<const double>)>& score,
                                std::span<const Genome> ancestors, const GeneticOptions& options) {
  assert(!ancestors.empty());
  RandomStream dice({.suite_seed = options.seed, .scenario = "training"}, "genetic-search");
  const auto draw_seed = [&dice] { return static_cast<unsigned>(dice.Bits()); };

  pagmo::population population(pagmo::problem(Problem{&score, ancestors.front().size()}), 0u, draw_seed());
  for (const Genome& ancestor : ancestors) population.push_back(ancestor);
  while (population.size() < static_cast<std::size_t>(options.population))
    population.push_back(population.random_decision_vector());

  // One generation a call, so that progress can be told; the algorithm keeps its dice between the calls.
  const pagmo::algorithm algorithm(pagmo::sga(1u, kCrossover, kSpreadIndex, kMutation, kMutationWidth, kTournament,
                                              "binomial", "gaussian", "tournament", draw_seed()));
  for (int generation = 1; generation <= options.generations; ++generation) {
    population = algorithm.evolve(population);
    if (options.progress) options.progress(generation, -population.champion_f()[0]);
  }
  return {population.champion_x(), -population.champion_f()[0], options.generations};
}

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

std::size_t CountMembershipGenes(const Memberships& start) {
  std::size_t count = 0;
  for (const auto& [feature, twin] : kTuned) {
    const Universe& universe = start.universes[static_cast<std::size_t>(feature)];
    for (std::size_t term = 0; term < TermsOf(feature).size(); ++term) {
      for (double breakpoint : BreakpointsOf(start.shapes[FirstTermOf(feature) + term])) {
        count += IsWithin(breakpoint, universe);
      }
    }
  }
  return count;
}

Memberships MembershipsOfGenes(const Memberships& start, std::span<const double> genes) {
  assert(genes.size() == CountMembershipGenes(start));
  Memberships tuned = start;
  std::size_t gene = 0;
  for (const auto& [feature, twin] : kTuned) {
    const Universe& universe = start.universes[static_cast<std::size_t>(feature)];
    const double reach = kBreakpointReach * (universe.high - universe.low);
    for (std::size_t term = 0; term < TermsOf(feature).size(); ++term) {
      const Shape& shape = start.shapes[FirstTermOf(feature) + term];
      std::vector<double> breakpoints = BreakpointsOf(shape);
      for (double& breakpoint : breakpoints) {
        if (!IsWithin(breakpoint, universe)) continue;
        breakpoint = std::clamp(breakpoint + (2 * genes[gene++] - 1) * reach, universe.low, universe.high);
      }
      std::sort(breakpoints.begin(), breakpoints.end());
      const Shape moved = WithBreakpoints(shape, breakpoints);
      tuned.shapes[FirstTermOf(feature) + term] = moved;
      tuned.shapes[FirstTermOf(twin) + term] = moved;
    }
  }
  return tuned;
}

}  // namespace etude
