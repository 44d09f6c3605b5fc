#include "bench/statistics/paired_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "bench/statistics/bootstrap.h"
#include "engine/base/order_statistics.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

/// Returns the differences 1 … n; those listed are negative.
std::vector<double> Ranks(int n, const std::vector<int>& negative) {
  std::vector<double> differences;
  for (int i = 1; i <= n; ++i) {
    differences.push_back(std::find(negative.begin(), negative.end(), i) == negative.end() ? i : -i);
  }
  return differences;
}

/// Darwin's maize: cross- minus self-fertilised, in eighths of an inch (Fisher 1935, The Design of Experiments, §17).
const std::vector<double> kDarwin = {49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};

double FlippedMeanP(std::vector<double> differences) {
  const double observed = std::abs(Mean(differences));
  int extreme = 0;
  const int all = 1 << differences.size();
  for (int bits = 0; bits < all; ++bits) {
    double sum = 0;
    for (std::size_t i = 0; i < differences.size(); ++i) sum += (bits >> i) & 1 ? -differences[i] : differences[i];
    extreme += std::abs(sum) / static_cast<double>(differences.size()) >= observed - 1e-9;
  }
  return static_cast<double>(extreme) / all;
}

TEST(SignedRank, AgreesWithTheTables) {
  // Two-sided critical values of the smaller rank sum (Hollander & Wolfe, table A.4): n = 10, W = 8.
  EXPECT_DOUBLE_EQ(*SignedRankTest(Ranks(10, {8})).p, 50.0 / 1024);
  EXPECT_DOUBLE_EQ(*SignedRankTest(Ranks(10, {9})).p, 66.0 / 1024);
  EXPECT_DOUBLE_EQ(*SignedRankTest(Ranks(6, {})).p, 2.0 / 64);
  EXPECT_NEAR(*SignedRankTest(Ranks(20, {20, 18, 14})).p, 0.0484, 0.0001);  // n = 20, W = 52
  EXPECT_EQ(SignedRankTest(Ranks(20, {})).how, "exact");
}

TEST(SignedRank, AgreesWithPublishedExamples) {
  // Hollander & Wolfe (1973), depression scale factors of nine patients: p = 0.0391.
  const std::vector<double> first = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> second = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> differences;
  for (std::size_t i = 0; i < first.size(); ++i) differences.push_back(second[i] - first[i]);
  EXPECT_DOUBLE_EQ(*SignedRankTest(differences).p, 0.0390625);
  EXPECT_DOUBLE_EQ(*SignedRankTest(kDarwin).p, 0.041259765625);  // scipy 1.10.1, mode='exact'
}

TEST(SignedRank, RanksZerosAsPrattDid) {
  // Enumerated by hand over the 2¹⁰ and 2⁸ signs. Zeros take the lowest ranks (Pratt).
  EXPECT_DOUBLE_EQ(*SignedRankTest(std::vector<double>{0, 0, 1, -2, 3, -4, 5, 6, 7, 8, 9, 10}).p, 0.029296875);
  EXPECT_DOUBLE_EQ(*SignedRankTest(std::vector<double>{0, 0, 1, 1, -2, 2, 3, -3, 3, 5}).p, 0.2421875);
  const PairedTest zeros = SignedRankTest(std::vector<double>(9, 0.0));
  EXPECT_EQ(*zeros.p, 1);
  EXPECT_FALSE(SignedRankTest({}).p);
}

TEST(SignedRank, ApproximatesLargeSamplesAsScipyDoes) {
  // scipy: stats.wilcoxon(v, zero_method='pratt', mode='approx', correction=True)
  std::vector<double> with_ties, without;
  for (int i = 0; i < 64; ++i) with_ties.push_back(i * 37 % 23 - 8);
  for (int i = 0; i < 60; ++i) without.push_back(std::fmod(i * 0.618, 1) * 3 - 1.2);
  EXPECT_NEAR(*SignedRankTest(with_ties).p, 0.0028360377859283302, 1e-9);
  EXPECT_NEAR(*SignedRankTest(without).p, 0.019423125355880328, 1e-9);
  EXPECT_EQ(SignedRankTest(without).how, "normal approximation");
}

TEST(SignedRank, HardlyNoticesWhereTheApproximationTakesOver) {
  const std::vector<int> negative = {2, 5, 9, 14, 20, 27, 30, 33, 35, 38, 41, 44, 47};
  const double exact = *SignedRankTest(Ranks(50, negative)).p, approximate = *SignedRankTest(Ranks(51, negative)).p;
  EXPECT_GT(exact, approximate);  // one more positive difference
  EXPECT_NEAR(std::log(exact / approximate), 0, 0.5);
}

TEST(RankBiserial, IsOneWhenAllGoOneWay) {
  EXPECT_EQ(RankBiserial(Ranks(7, {})), 1);
  EXPECT_EQ(RankBiserial(Ranks(3, {1, 2, 3})), -1);
  EXPECT_DOUBLE_EQ(RankBiserial(Ranks(10, {8})), (47.0 - 8) / 55);
  EXPECT_EQ(RankBiserial(std::vector<double>(4, 0.0)), 0);
}

TEST(SignFlip, IsFishersAnswerToDarwin) {
  // Of the 32,768 ways to sign the differences, 863 give a sum at least as large, and 863 one at most as small.
  const PairedTest test = SignFlipTest(kDarwin, Aggregate::kMean, 1, "x");
  EXPECT_DOUBLE_EQ(*test.p, 2 * 863 / 32768.0);
  EXPECT_EQ(test.how, "exact");
  EXPECT_DOUBLE_EQ(*SignFlipTest(kDarwin, Aggregate::kMedian, 1, "x").p, 0.109375);  // scipy.stats.permutation_test
}

TEST(SignFlip, CountsEverySignOnceWhateverTheZerosAndTies) {
  for (const std::vector<double>& sample : {std::vector<double>{0.1, 0.2, -0.3, 0.4, 0.4, 0.5},
                                            {0, 0, 3, -1, 2, 2, 0},
                                            {5},
                                            {1, 1, 1, 2, -1, 3, 0.5, 0.25, -0.125}}) {
    EXPECT_DOUBLE_EQ(*SignFlipTest(sample, Aggregate::kMean, 1, "x").p, FlippedMeanP(sample));
  }
  EXPECT_EQ(*SignFlipTest(std::vector<double>(3, 0.0), Aggregate::kMean, 1, "x").p, 1);
  EXPECT_FALSE(SignFlipTest({}, Aggregate::kMean, 1, "x").p);
}

TEST(SignFlip, OfSharesIsMcNemarsExactTest) {
  // Ten worlds are gained and two lost; equal worlds do not matter: 2 · P(Binomial(12, ½) ≥ 10).
  std::vector<double> differences(12, 1.0);
  differences[0] = differences[5] = -1;
  differences.resize(400, 0.0);
  const PairedTest test = SignFlipTest(differences, Aggregate::kMean, 1, "x");
  EXPECT_NEAR(*test.p, 0.03857421875, 1e-9);
  EXPECT_EQ(test.how, "exact");
}

TEST(SignFlip, DrawsSignsWhenThereAreTooManyToCount) {
  RandomStream dice({.suite_seed = 2, .scenario = "t", .trial = 0}, "x");
  for (Aggregate aggregate : {Aggregate::kMean, Aggregate::kMedian}) {
    std::vector<double> sixteen;
    for (int i = 0; i < 16; ++i) sixteen.push_back(dice.Normal(0.3, 1));
    std::vector<double> seventeen = sixteen;
    seventeen.push_back(1e-6);
    const PairedTest exact = SignFlipTest(sixteen, aggregate, 1, "x");
    const PairedTest drawn = SignFlipTest(seventeen, aggregate, 1, "x");
    EXPECT_EQ(drawn.how, "9,999 draws");
    // The added tiny difference does not change the mean's test, but it changes the median's by half a rank.
    EXPECT_NEAR(*drawn.p, *exact.p, aggregate == Aggregate::kMean ? 0.02 : 0.15);
    EXPECT_EQ(*SignFlipTest(seventeen, aggregate, 1, "x").p, *drawn.p);
    EXPECT_NE(*SignFlipTest(seventeen, aggregate, 2, "x").p, *drawn.p);
  }
  // p is never zero, because the sample itself is one of the ways.
  EXPECT_DOUBLE_EQ(*SignFlipTest(Ranks(200, {1}), Aggregate::kMean, 1, "x").p, 1e-4);
  EXPECT_DOUBLE_EQ(*SignFlipTest(Ranks(200, {}), Aggregate::kMedian, 1, "x").p, 1e-4);
}

TEST(SignFlip, IsExactForAMeanOfDifferencesOfOneSign) {
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> differences = {0, 0};
    for (int i = 1; i <= 25; ++i) differences.push_back(sign * i);
    const PairedTest test = SignFlipTest(differences, Aggregate::kMean, 1, "x");
    EXPECT_EQ(*test.p, std::ldexp(1.0, -24)) << "2 / 2^25: of all signs, these and their opposites";
    EXPECT_EQ(test.how, "exact");
    EXPECT_EQ(SignFlipTest(differences, Aggregate::kMedian, 1, "x").how, "9,999 draws");
  }
}

/// Under random signs, the median of 12 equal sizes is 0 if six are negative, otherwise as far from 0 as observed.
TEST(SignFlip, OfTheMedianIsNoTestOfTheMean) {
  const std::vector<double> same(12, -3);
  EXPECT_DOUBLE_EQ(*SignFlipTest(same, Aggregate::kMedian, 1, "x").p, 1 - 924 / 4096.0);
  EXPECT_DOUBLE_EQ(*SignFlipTest(same, Aggregate::kMean, 1, "x").p, 2 / 4096.0);
}

TEST(SignFlip, CountsNoSignsOfRounding) {
  for (const int roundings : {5, 30}) {  // 5: the test enumerates all signs; 30: it draws signs at random
    std::vector<double> differences(static_cast<std::size_t>(roundings), 1e-16);
    differences.insert(differences.end(), {1, 2});
    EXPECT_EQ(*SignFlipTest(differences, Aggregate::kMean, 1, "x").p, 0.5) << "2 / 2^2: as of 1 and 2 alone";
    differences.front() = -1e-16;
    EXPECT_EQ(*SignFlipTest(differences, Aggregate::kMean, 1, "x").p, 0.5);
  }
}

/// The reference sorts; the code counts bits.
TEST(SignFlip, FindsTheMedianOfFlippedSigns) {
  std::vector<double> differences;
  for (int i = 1; i <= 15; ++i) differences.push_back(i % 4 == 0 ? -0.7 * i : 1.3 * i);
  differences.push_back(0);
  const double observed = std::abs(Quantile(differences, 0.5));
  int extreme = 0;
  for (int bits = 0; bits < 1 << 15; ++bits) {
    std::vector<double> flipped = differences;
    for (int i = 0; i < 15; ++i) flipped[i] *= (bits >> i) & 1 ? -1 : 1;
    extreme += std::abs(Quantile(flipped, 0.5)) >= observed - 1e-9;
  }
  EXPECT_DOUBLE_EQ(*SignFlipTest(differences, Aggregate::kMedian, 1, "x").p, extreme / 32768.0);
}

/// Returns the share of samples whose p is at most 5 %.
double RejectionRate(double effect, int n, const std::function<PairedTest(const std::vector<double>&)>& test) {
  int rejected = 0;
  const int experiments = 400;
  for (int i = 0; i < experiments; ++i) {
    RandomStream dice({.suite_seed = 8, .scenario = "level", .trial = i}, "sample");
    std::vector<double> differences(n);
    for (double& difference : differences) difference = dice.Normal(effect, 1);
    rejected += *test(differences).p <= 0.05;
  }
  return static_cast<double>(rejected) / experiments;
}

TEST(PairedTests, KeepTheirLevelAndFindAnEffect) {
  const auto ranks = [](const std::vector<double>& d) { return SignedRankTest(d); };
  const auto flips = [](const std::vector<double>& d) { return SignFlipTest(d, Aggregate::kMean, 1, "x"); };
  for (int n : {12, 60}) {
    EXPECT_NEAR(RejectionRate(0, n, ranks), 0.05, 0.035) << n;
    EXPECT_GT(RejectionRate(1, n, ranks), 0.8) << n;
  }
  EXPECT_NEAR(RejectionRate(0, 12, flips), 0.05, 0.035);
  EXPECT_GT(RejectionRate(1, 12, flips), 0.8);
}

TEST(PairsNeeded, IsWhereTheSmallestPOfATestReachesItsLevel) {
  EXPECT_DOUBLE_EQ(SmallestP(5), 0.0625);
  EXPECT_EQ(SmallestP(0), 1);
  EXPECT_EQ(PairsNeeded(1, 0.05), 6);
  EXPECT_EQ(PairsNeeded(12, 0.05), 9);
  EXPECT_EQ(PairsNeeded(96, 0.05), 12);
  EXPECT_EQ(PairsNeeded(1, 0.01), 8);
}

TEST(SignFlipTest, OfVeryManyDifferencesIsNormal) {
  RandomStream dice({.suite_seed = 6, .scenario = "many", .trial = 0}, "x");
  std::vector<double> differences(kMaxResampled);
  for (double& difference : differences) difference = dice.Normal(0.01, 1);
  const PairedTest drawn = SignFlipTest(differences, Aggregate::kMean, 1, "x");
  differences.push_back(0.01);
  const PairedTest of_mean = SignFlipTest(differences, Aggregate::kMean, 1, "x");
  EXPECT_EQ(of_mean.how, "normal approximation");
  EXPECT_NEAR(*of_mean.p, *drawn.p, 0.02);
  // For a median the test is the sign test: z = |2k − n| / √n.
  const auto above = std::count_if(differences.begin(), differences.end(), [](double value) { return value > 0; });
  const double z = std::abs(2.0 * static_cast<double>(above) - (kMaxResampled + 1)) / std::sqrt(kMaxResampled + 1);
  EXPECT_NEAR(*SignFlipTest(differences, Aggregate::kMedian, 1, "x").p, std::erfc(z / std::sqrt(2)), 1e-8);
}

}  // namespace
}  // namespace etude
