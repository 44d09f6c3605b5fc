#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "tests/bench/statistics/verdict_rates.h"

namespace etude {
namespace {

constexpr SampleLaw kAllLaws[] = {SampleLaw::kNormal, SampleLaw::kHeavyTailed, SampleLaw::kTies, SampleLaw::kShares,
                                  SampleLaw::kCensored};

struct Moments {
  double mean = 0, deviation = 0;
  double correlation = 0;  ///< correlation of two worlds of one unit
};

Moments MomentsOf(const SampleDesign& design, double effect) {
  RandomStream dice({.suite_seed = 1, .scenario = "moments", .trial = 0}, "x");
  double sum = 0, squares = 0, products = 0;
  constexpr int kSamples = 2000;
  const int worlds = design.units * 2;
  for (int i = 0; i < kSamples; ++i) {
    const UnitSample sample = DrawSample(design, effect, dice);
    for (std::size_t w = 0; w < sample.differences.size(); w += 2) {
      const double a = sample.differences[w], b = sample.differences[w + 1];
      sum += a + b;
      squares += a * a + b * b;
      products += a * b;
    }
  }
  const double n = static_cast<double>(kSamples) * worlds;
  const double mean = sum / n, variance = squares / n - mean * mean;
  return {mean, std::sqrt(variance), (products / (n / 2) - mean * mean) / variance};
}

TEST(DrawSample, HasTheMeanAndTheCorrelationItSays) {
  for (SampleLaw law : kAllLaws) {
    for (double effect : {0.0, 2.0}) {
      const Moments found = MomentsOf({.law = law, .units = 10, .trials = 2, .alike = 0.5}, effect);
      EXPECT_NEAR(found.mean, effect * JustMatters(law), 0.03) << SampleLawName(law);
      if (effect > 0) continue;
      const double sixth = law == SampleLaw::kShares || law == SampleLaw::kCensored ? 6 : 3;
      // The sample variance of t₃ does not converge usefully, because its fourth moment is infinite.
      EXPECT_NEAR(found.deviation / JustMatters(law) / sixth, 1, law == SampleLaw::kHeavyTailed ? 0.15 : 0.03)
          << SampleLawName(law);
      const bool is_exact = law == SampleLaw::kNormal || law == SampleLaw::kShares;
      EXPECT_NEAR(found.correlation, 0.5, is_exact ? 0.03 : 0.35) << SampleLawName(law);
    }
  }
}

// A second implementation of the laws' centres: the median of the means of pairs.
TEST(DrawSample, OfUnevenUnitsHasThePseudoMedianZero) {
  for (SampleLaw law : {SampleLaw::kLogNormal, SampleLaw::kFarOff, SampleLaw::kBimodal}) {
    RandomStream dice({.suite_seed = 1, .scenario = "centre", .trial = 0}, "x");
    const UnitSample sample = DrawSample({.law = law, .units = 200'000, .trials = 1, .alike = 1}, 0, dice);
    int below = 0;
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < sample.differences.size(); i += 2) {
      const double a = sample.differences[i], b = sample.differences[i + 1];
      below += a + b < 0;
      sum += a + b;
      squares += a * a + b * b;
    }
    const double n = static_cast<double>(sample.differences.size());
    EXPECT_NEAR(2 * below / n, 0.5, 0.006) << SampleLawName(law);
    EXPECT_NEAR(std::sqrt(squares / n - sum / n * sum / n) / JustMatters(law), 3, 0.1) << SampleLawName(law);
  }
}

TEST(DrawSample, DrawsWorldsOfTwoDifferentUnits) {
  RandomStream dice({.suite_seed = 1, .scenario = "pairs", .trial = 0}, "x");
  const UnitSample sample = DrawSample({.units = 6, .trials = 60, .alike = 0.5, .in_pairs = true}, 0, dice);
  ASSERT_EQ(sample.units.size(), 60u);
  for (const std::vector<int>& units : sample.units) {
    ASSERT_EQ(units.size(), 2u);
    EXPECT_NE(units[0], units[1]);
  }
}

TEST(MeasureVerdicts, KeepsItsPromiseAndFindsWhatIsThere) {
  for (SampleLaw law : kAllLaws) {
    const VerdictRates rates = MeasureVerdicts({.law = law, .units = 8, .trials = 3, .alike = 0.5}, {400, 100});
    EXPECT_LE(rates.false_alarms.low, 5) << SampleLawName(law);
    EXPECT_GE(rates.coverage_without, 90) << SampleLawName(law);
    EXPECT_LE(rates.power[0], rates.power[2]) << SampleLawName(law);
  }
  const VerdictRates pairs = MeasureVerdicts({.units = 8, .trials = 60, .alike = 0.5, .in_pairs = true}, {400, 100});
  EXPECT_LE(pairs.false_alarms.low, 5);
  EXPECT_GE(pairs.power[2], 80);
}

TEST(MeasureVerdicts, HoldsWithUnevenUnits) {
  for (SampleLaw law : {SampleLaw::kLogNormal, SampleLaw::kFarOff, SampleLaw::kBimodal}) {
    for (int units : {6, 12}) {
      const VerdictRates rates = MeasureVerdicts({.law = law, .units = units, .trials = 1, .alike = 1}, {1000, 100});
      EXPECT_LE(rates.false_alarms.low, 5) << SampleLawName(law);
      EXPECT_GE(rates.coverage_without, 92) << SampleLawName(law);
    }
  }
}

TEST(MeasureVerdicts, TellsWhatATestOverWorldsWouldHaveClaimed) {
  // The control: correlated worlds of eight units, treated as independent, give false alarms.
  const VerdictRates alike = MeasureVerdicts({.units = 8, .trials = 10, .alike = 0.5}, {400, 1});
  EXPECT_GE(alike.false_alarms_of_worlds.low, 25);
  const VerdictRates apart = MeasureVerdicts({.units = 8, .trials = 10, .alike = 0}, {400, 1});
  EXPECT_LE(apart.false_alarms_of_worlds.low, 5);
}

/// Returns the numbers of every line of a table except its head.
std::vector<std::vector<double>> NumbersOf(std::istream& table) {
  std::vector<std::vector<double>> numbers;
  for (std::string line; std::getline(table, line);) {
    if (line.size() < 3 || !std::isdigit(static_cast<unsigned char>(line[2]))) continue;
    std::ranges::replace_if(
        line, [](unsigned char c) { return !std::isdigit(c) && c != '.'; }, ' ');
    std::istringstream words(line);
    numbers.emplace_back(std::istream_iterator<double>(words), std::istream_iterator<double>());
  }
  return numbers;
}

// Draws 10,000 samples of each design; takes minutes.
TEST(MeasureVerdicts, HEAVY_FindsThePublishedRatesAndKeepsThePromise) {
  std::vector<VerdictRates> rates;
  for (const SampleDesign& design : PublishedDesigns()) rates.push_back(MeasureVerdicts(design, {10'000, 2'000}));
  EXPECT_EQ(rates.size(), 36u * 5 + 24u * 3 + 7u * 4);
  for (const VerdictRates& one : rates) {
    EXPECT_TRUE(KeepsPromise(one, rates.size())) << SampleLawName(one.design.law) << ", " << one.design.units;
  }
  const std::string text = VerdictRatesMarkdown(rates);
  std::istringstream table(text);
  std::ifstream file("docs/figures/verdicts.txt");
  const auto measured = NumbersOf(table), published = NumbersOf(file);
  ASSERT_EQ(published.size(), 67u);
  ASSERT_EQ(measured.size(), 67u);
  for (std::size_t line = 0; line < published.size(); ++line) {
    // Another mathematics library may round a last bit differently.
    EXPECT_THAT(measured[line], ::testing::Pointwise(::testing::DoubleNear(1.01), published[line])) << line;
  }
  if (HasFailure()) std::cout << text;  // print the table that replaces the page's if the change is intended
}

// The values of `rates` lie at the bounds of the promise and still keep it. By the score test with 280 designs (level
// 0.05 / 280, z = 3.57), a true rate of 5 % is rejected if more than 577 of 10,000 samples give a false alarm (500 +
// 3.57 × 21.8 = 578), and a true rate of 6 % if more than 684 do.
TEST(KeepsPromise, NeedsFewFalseAlarmsForCertainAndIntervalsThatHoldTheTruth) {
  constexpr std::size_t kDesigns = 280;
  VerdictRates rates{.false_alarms = {.count = 577, .of = 10'000, .percent = 5.77, .low = 5.3, .high = 6.5}};
  rates.coverage_without = 93;
  EXPECT_TRUE(KeepsPromise(rates, kDesigns));
  const auto breaks = [&](auto change) {
    VerdictRates broken = rates;
    change(broken);
    return !KeepsPromise(broken, kDesigns);
  };
  EXPECT_TRUE(breaks([](VerdictRates& r) { r.false_alarms.count = 578; })) << "above 5 % for all that samples can tell";
  EXPECT_TRUE(breaks([](VerdictRates& r) { r.false_alarms.high = 6.51; })) << "too few samples to be certain";
  EXPECT_TRUE(breaks([](VerdictRates& r) { r.coverage_without = 92.9; }));
  EXPECT_FALSE(breaks([](VerdictRates& r) { r.false_alarms_of_worlds.percent = 60; })) << "that is told, not promised";
  EXPECT_FALSE(breaks([](VerdictRates& r) { r.power = {}; }));
  EXPECT_FALSE(KeepsPromise(rates, 1)) << "of a single design more than 535 are too many";
  rates.design.law = SampleLaw::kLogNormal;
  rates.false_alarms.count = 684;
  EXPECT_TRUE(KeepsPromise(rates, kDesigns)) << "6 % with uneven units";
  EXPECT_TRUE(breaks([](VerdictRates& r) { r.false_alarms.count = 685; }));
  EXPECT_FALSE(KeepsPromise({}, kDesigns)) << "nothing measured";
}

}  // namespace
}  // namespace etude
