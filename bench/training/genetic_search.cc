#include "bench/training/genetic_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dlfcn.h>
#include <numeric>
#include <stdexcept>

#include "bench/training/training_pairs.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

/// Loads the module. The dynamic linker finds it next to the program by the program's run path (cli/CMakeLists.txt).
Result<PagmoEvolve*> OpenModule() {
  void* module = ::dlopen("etude_training_pagmo.so", RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) return Fail({}, "the genetic algorithm cannot be loaded: {}", ::dlerror());
  const void* symbol = ::dlsym(module, "etude_pagmo_evolve");
  if (symbol == nullptr) return Fail({}, "etude_training_pagmo.so is not a module of this program");
  return *static_cast<PagmoEvolve* const*>(symbol);
}

const Result<PagmoEvolve*>& Module() {
  static const Result<PagmoEvolve*> loaded = OpenModule();
  return loaded;
}

using enum Feature;
/// The features that are tuned, each with the corresponding feature of the body's other side. Both features of a pair
/// are tuned together.
constexpr Feature kTuned[][2] = {{kRH, kLH},       {kRHE, kLHE}, {kPosture, kPosture},
                                 {kTrunk, kTrunk}, {kRF, kLF},   {kRFK, kLFK}};

/// Returns the breakpoints of a shape in ascending order. Gaussian and singleton shapes have none.
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

Result<void> LoadGeneticSearch() {
  if (!Module()) return tl::unexpected(Module().error());
  return {};
}

GeneticResult SearchGenetically(const std::function<double(std::span<const double>)>& score,
                                std::span<const Genome> ancestors, const GeneticOptions& options) {
  assert(!ancestors.empty());
  RandomStream dice({.suite_seed = options.seed, .scenario = "training"}, "genetic-search");
  const auto draw_seed = [&dice] { return static_cast<unsigned>(dice.Bits()); };

  if (!Module()) throw std::runtime_error(Module().error().message);
  const unsigned population_seed = draw_seed(), algorithm_seed = draw_seed();
  GeneticResult result;
  (*Module())(score, ancestors, options, population_seed, algorithm_seed, result);
  return result;
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
