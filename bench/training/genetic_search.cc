#include "bench/training/genetic_search.h"

#include <dlfcn.h>

#include <cassert>
#include <stdexcept>

#include "sim/random/stream.h"

namespace etude {
namespace {

/// The module is found beside the program: by its run path (cli/CMakeLists.txt).
Result<PagmoEvolve*> OpenModule() {
  void* module = ::dlopen("etude_training_pagmo.so", RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) return Fail({}, "the genetic algorithm cannot be loaded: {}", ::dlerror());
  const void* symbol = ::dlsym(module, "etude_pagmo_evolve");
  if (symbol == nullptr) return Fail({}, "etude_training_pagmo.so is no module of this program");
  return *static_cast<PagmoEvolve* const*>(symbol);
}

const Result<PagmoEvolve*>& Module() {
  static const Result<PagmoEvolve*> loaded = OpenModule();
  return loaded;
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

}  // namespace etude
