#include "bench/training/match_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/random/stream.h"

namespace etude {
namespace {

std::vector<LabelledPair> RandomPairs(int count) {
  RandomStream dice({.scenario = "match-score"}, "pairs");
  std::vector<LabelledPair> pairs(static_cast<std::size_t>(count));
  for (LabelledPair& pair : pairs) {
    for (double& gap : pair.squared_gaps) gap = 0.1 * dice.Uniform() * dice.Uniform();
    pair.close = dice.Chance(0.2);
  }
  return pairs;
}

TEST(MatchScore, CountsLikeALoopOverEquation1) {
  const std::vector<LabelledPair> pairs = RandomPairs(1000);  // no multiple of a block
  const FeatureWeights weights = {0, 2, 1, 0.5, 0, 1.5, 1, 1, 0.5, 0.5};
  const PairTable table(pairs);
  int checked = 0;
  for (double threshold : {0.2, 0.4, 0.6}) {
    MatchScore expected;
    for (const LabelledPair& pair : pairs) {
      double squared = 0;
      for (std::size_t k = 0; k < kFeatureCount; ++k) squared += weights[k] * pair.squared_gaps[k];
      const bool matched = std::sqrt(squared) < threshold;
      expected.matched += matched;
      expected.close += pair.close;
      expected.close_matched += matched && pair.close;
    }
    const MatchScore score = table.Score(weights, threshold);
    EXPECT_EQ(score.matched, expected.matched) << threshold;
    EXPECT_EQ(score.close, expected.close);
    EXPECT_EQ(score.close_matched, expected.close_matched);
    checked += expected.matched > 0 && expected.matched < 1000;
  }
  EXPECT_GE(checked, 2) << "thresholds that tell pairs apart";
}

TEST(MatchScore, SoftF1TendsToF1AsTheRampNarrows) {
  const PairTable table(RandomPairs(1000));
  const double hard = table.Score(PaperWeights()).F1();
  EXPECT_NEAR(table.SoftF1(PaperWeights(), kPaperThreshold, 1e-6), hard, 1e-6);
  EXPECT_GT(std::abs(table.SoftF1(PaperWeights(), kPaperThreshold, 0.5) - hard), 1e-3) << "control";
}

TEST(MatchScore, SoftF1CountsAPairOnTheThresholdByHalf) {
  LabelledPair on{.close = true}, far{.close = true};
  on.squared_gaps[0] = 0.16;
  far.squared_gaps[0] = 1;
  const LabelledPair pairs[] = {on, far};
  EXPECT_NEAR(PairTable(pairs).SoftF1(PaperWeights(), 0.4, 0.1), 2 * 0.5 / (0.5 + 2), 1e-6);
}

TEST(MatchScore, F1IsTheHarmonicMeanOfPrecisionAndRecall) {
  const MatchScore score{.matched = 8, .close = 12, .close_matched = 6};
  EXPECT_DOUBLE_EQ(score.F1(), 2 / (1 / (6.0 / 8) + 1 / (6.0 / 12)));
  EXPECT_EQ((MatchScore{.matched = 8, .close = 12, .close_matched = 0}).F1(), 0);
  EXPECT_EQ(MatchScore{}.F1(), 0) << "nothing asked, nothing known";
}

}  // namespace
}  // namespace etude
