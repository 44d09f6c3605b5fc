#include "engine/fuzzy/weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace etude {
namespace {

double Sum(const FeatureWeights& weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

/// Adds 100 pairs with these gaps; the first `close` are close.
void AddPairs(std::vector<LabelledPair>& pairs, const PerFeature& gaps, int close) {
  for (int i = 0; i < 100; ++i) pairs.push_back({gaps, i < close});
}

PerFeature OnlyGap(std::size_t feature, double gap) {
  PerFeature gaps{};
  gaps[feature] = gap;
  return gaps;
}


// A saturated model has a closed form. With one group of pairs per unknown, each group's fitted probability is its
// share: b = logit(share of the group without gaps), w_k = (b − logit(share_k)) / gap_k.
TEST(FitWeights, MatchesTheClosedFormOfASaturatedModel) {
  std::vector<LabelledPair> pairs;
  AddPairs(pairs, PerFeature{}, 90);
  const int shares[] = {10, 20, 30, 40, 50, 60, 70, 80, 85, 88};
  const auto logit = [](double percent) { return std::log(percent / (100 - percent)); };
  PerFeature expected;
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    const double gap = 0.5 + 0.1 * static_cast<double>(k);
    AddPairs(pairs, OnlyGap(k, gap), shares[k]);
    expected[k] = (logit(90) - logit(shares[k])) / gap;
  }
  const WeightFit fit = FitWeights(pairs, {.ridge = 1e-9});
  ASSERT_EQ(fit.status, WeightFitStatus::kFitted);
  const double scale = kWeightSum / Sum(expected);
  for (std::size_t k = 0; k < kFeatureCount; ++k) EXPECT_NEAR(fit.weights[k], expected[k] * scale, 1e-6) << k;
  EXPECT_NEAR(Sum(fit.weights), kWeightSum, 1e-12);
  EXPECT_EQ(fit.pairs, 1100);
  EXPECT_EQ(fit.close_pairs, 90 + 533);
}

TEST(FitWeights, ClipsAFeatureThatPointsTheWrongWay) {
  std::vector<LabelledPair> pairs;
  AddPairs(pairs, PerFeature{}, 50);
  AddPairs(pairs, OnlyGap(0, 1), 10);
  AddPairs(pairs, OnlyGap(1, 1), 90);  // pairs with a gap are close more often here, which no distance can express
  const WeightFit fit = FitWeights(pairs);
  ASSERT_EQ(fit.status, WeightFitStatus::kFitted);
  EXPECT_EQ(fit.weights[1], 0);
  EXPECT_NEAR(fit.weights[0], kWeightSum, 1e-9);
}

TEST(FitWeights, StaysFiniteOnSeparablePairs) {
  std::vector<LabelledPair> pairs;
  AddPairs(pairs, PerFeature{}, 100);
  AddPairs(pairs, OnlyGap(3, 2), 0);
  const WeightFit fit = FitWeights(pairs);
  ASSERT_EQ(fit.status, WeightFitStatus::kFitted);
  EXPECT_NEAR(fit.weights[3], kWeightSum, 1e-9);
}

TEST(FitWeights, KeepsThePapersWeightsWhenThereIsNothingToLearn) {
  std::vector<LabelledPair> pairs;
  AddPairs(pairs, OnlyGap(0, 1), 0);
  const WeightFit far_only = FitWeights(pairs);
  EXPECT_EQ(far_only.status, WeightFitStatus::kOneClassOnly);
  EXPECT_EQ(far_only.weights, PaperWeights());
  EXPECT_EQ(FitWeights({}).status, WeightFitStatus::kOneClassOnly);

  pairs.clear();
  AddPairs(pairs, PerFeature{}, 10);
  AddPairs(pairs, OnlyGap(0, 1), 90);
  const WeightFit backwards = FitWeights(pairs);
  EXPECT_EQ(backwards.status, WeightFitStatus::kNothingCounts);
  EXPECT_EQ(backwards.weights, PaperWeights());
}

}  // namespace
}  // namespace etude
