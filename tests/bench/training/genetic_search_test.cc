#include "bench/training/genetic_search.h"

#include <gtest/gtest.h>

#include <numeric>

#include "bench/training/training_pairs.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

double NegativeSquaredDistance(std::span<const double> genes) {
  double sum = 0;
  for (std::size_t i = 0; i < genes.size(); ++i) sum -= std::pow(genes[i] - (0.1 + 0.2 * static_cast<double>(i)), 2);
  return sum;
}

TEST(GeneticSearch, ClimbsToAKnownPeak) {
  const Genome ancestors[] = {Genome(5, 1.0)};
  const GeneticResult result = SearchGenetically(NegativeSquaredDistance, ancestors);
  EXPECT_GT(result.score, -0.01) << "1 % of the ancestor's 1.65 away";
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(result.best[i], 0.1 + 0.2 * static_cast<double>(i), 0.1);
  EXPECT_EQ(result.score, NegativeSquaredDistance(result.best));
}

TEST(GeneticSearch, RepeatsItselfBySeed) {
  const Genome ancestors[] = {Genome(5, 1.0)};
  const GeneticOptions brief{.generations = 5};
  const GeneticResult first = SearchGenetically(NegativeSquaredDistance, ancestors, brief);
  EXPECT_EQ(first.best, SearchGenetically(NegativeSquaredDistance, ancestors, brief).best);
  EXPECT_NE(first.best, SearchGenetically(NegativeSquaredDistance, ancestors, {.generations = 5, .seed = 2}).best);
}

TEST(GeneticSearch, IsNeverWorseThanItsAncestorsAndTellsEveryGeneration) {
  const Genome ancestors[] = {Genome(5, 1.0), {0.1, 0.3, 0.5, 0.7, 0.9}};
  std::vector<double> told;
  GeneticOptions options{.population = 4, .generations = 3};
  options.progress = [&told](int generation, double best) {
    EXPECT_EQ(generation, static_cast<int>(told.size()) + 1);
    told.push_back(best);
  };
  EXPECT_NEAR(SearchGenetically(NegativeSquaredDistance, ancestors, options).score, 0, 1e-30);
  EXPECT_EQ(told.size(), 3u);
}

/// Returns pairs in which only the left arm and knee decide whether they are close; the rest is noise.
std::vector<LabelledPair> PlantedPairs() {
  RandomStream dice({.scenario = "genetic-weights"}, "pairs");
  std::vector<LabelledPair> pairs(3000);
  for (LabelledPair& pair : pairs) {
    for (double& gap : pair.squared_gaps) gap = dice.Chance(0.5) ? 0.02 * dice.Uniform() : dice.Uniform();
    pair.close = 4 * pair.squared_gaps[1] + 4 * pair.squared_gaps[9] < 0.16;
  }
  return pairs;
}

TEST(GeneticWeights, FindThePlantedFeatures) {
  const std::vector<LabelledPair> pairs = PlantedPairs();
  const WeightFit fit = FitWeightsGenetically(pairs, PaperWeights());
  ASSERT_EQ(fit.status, WeightFitStatus::kFitted);
  EXPECT_EQ(fit.pairs, 3000);
  EXPECT_NEAR(std::accumulate(fit.weights.begin(), fit.weights.end(), 0.0), kWeightSum, 1e-12);
  EXPECT_GT(fit.weights[1] + fit.weights[9], 6);
  for (double weight : fit.weights) EXPECT_GE(weight, 0);
  const PairTable table(pairs);
  EXPECT_LT(table.Score(PaperWeights()).F1(), 0.5);
  EXPECT_GT(table.Score(fit.weights).F1(), 0.9);
}

TEST(GeneticWeights, KeepTheStartWhereThereIsNothingToLearn) {
  std::vector<LabelledPair> pairs = PlantedPairs();
  for (LabelledPair& pair : pairs) pair.close = false;
  FeatureWeights start{};
  start[3] = kWeightSum;
  const WeightFit fit = FitWeightsGenetically(pairs, start);
  EXPECT_EQ(fit.status, WeightFitStatus::kOneClassOnly);
  EXPECT_EQ(fit.weights, start);
  EXPECT_EQ(FitWeightsGenetically({}, start).status, WeightFitStatus::kOneClassOnly);
}

TEST(GeneticWeights, GenesAreProportions) {
  const FeatureWeights weights = *WeightsOfGenes(GenesOf(PaperWeights()));
  for (std::size_t k = 0; k < kFeatureCount; ++k) EXPECT_NEAR(weights[k], PaperWeights()[k], 1e-12);
  EXPECT_FALSE(WeightsOfGenes(Genome(kFeatureCount, 0.0))) << "no proportions";
}

}  // namespace

}  // namespace etude
