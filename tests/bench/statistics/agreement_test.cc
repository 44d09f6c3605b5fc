#include "bench/statistics/agreement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

AgreementSums SumsOf(const std::vector<double>& truth, const std::vector<double>& found) {
  return SumAgreement({{"a"}, found}, {{"a"}, truth}, 0);
}

/// Differences of three people in 4, 2 and 3 frames.
const std::vector<std::vector<double>> kDifferences = {{1, 2, 1.5, 2.5}, {-1, 0}, {3, 2, 4}};

TEST(MeasureAgreement, LimitsAreThoseOfAnAnalysisOfVariance) {
  // Bland and Altman's sums, computed directly from the differences.
  double n = 0, sum = 0, squares = 0;
  for (const auto& person : kDifferences) {
    for (const double d : person) sum += d;
    n += static_cast<double>(person.size());
    squares += static_cast<double>(person.size() * person.size());
  }
  const double bias = sum / n;
  double within = 0, between = 0;
  for (const auto& person : kDifferences) {
    double mean = 0;
    for (const double d : person) mean += d / static_cast<double>(person.size());
    for (const double d : person) within += (d - mean) * (d - mean);
    between += static_cast<double>(person.size()) * (mean - bias) * (mean - bias);
  }
  within /= n - 3;
  between /= 2;
  const double deviation = std::sqrt(within + (between - within) / ((n * n - squares) / (2 * n)));
  std::vector<AgreementSums> pairs;
  std::vector<std::string> units;
  for (const auto& person : kDifferences) {
    std::vector<double> truth(person.size(), 10.0), found;
    for (std::size_t f = 0; f < person.size(); ++f) truth[f] += static_cast<double>(f);
    for (std::size_t f = 0; f < person.size(); ++f) found.push_back(truth[f] + person[f]);
    pairs.push_back(SumsOf(truth, found));
    units.push_back("p" + std::to_string(pairs.size()));
  }
  const CurveAgreement agreement = MeasureAgreement(pairs, units, 1, "test");
  EXPECT_EQ(agreement.units, 3);
  EXPECT_NEAR(*agreement.bias.value, bias, 1e-12);
  EXPECT_NEAR(*agreement.low.value, bias - 1.96 * deviation, 1e-12);
  EXPECT_NEAR(*agreement.high.value, bias + 1.96 * deviation, 1e-12);
  EXPECT_FALSE(agreement.bias.interval) << "three people are too few";
  // The control: the deviation of all frames pooled differs.
  double pooled = 0;
  for (const auto& person : kDifferences) {
    for (const double d : person) pooled += (d - bias) * (d - bias) / (n - 1);
  }
  EXPECT_GT(std::abs(deviation - std::sqrt(pooled)), 0.05);
  // A person's frames may be split into two pairs without changing the result.
  std::vector<AgreementSums> split = pairs;
  split[0] = SumsOf({10, 11}, {11, 13});
  split.push_back(SumsOf({12, 13}, {13.5, 15.5}));
  std::vector<std::string> more = units;
  more.push_back("p1");
  EXPECT_NEAR(*MeasureAgreement(split, more, 1, "test").high.value, *agreement.high.value, 1e-12);
}

TEST(MeasureAgreement, OnePersonHasNoLimits) {
  const std::vector<AgreementSums> pairs = {SumsOf({1, 2, 3}, {2, 2, 4})};
  const CurveAgreement agreement = MeasureAgreement(pairs, std::vector<std::string>{"p"}, 1, "test");
  EXPECT_TRUE(agreement.rmse.value);
  EXPECT_FALSE(agreement.low.value);
}

// The biases of people have standard deviation 2, and the noise of frames has standard deviation 1. So the limits of
// agreement are ±1.96 · √5, and the intervals of the mean bias must contain 0 as often as they claim.
TEST(MeasureAgreement, IntervalsAreOverPeople) {
  constexpr int kStudies = 60, kPeople = 12, kFrames = 50;
  int covered = 0, too_narrow = 0;
  double high = 0;
  unsigned state = 7;
  const auto normal = [&] {  // the sum of twelve uniform numbers is nearly normal
    double sum = -6;
    for (int i = 0; i < 12; ++i) {
      state = state * 1664525u + 1013904223u;
      sum += static_cast<double>(state >> 8) / 16777216.0;
    }
    return sum;
  };
  for (int study = 0; study < kStudies; ++study) {
    std::vector<AgreementSums> pairs;
    std::vector<std::string> units;
    for (int person = 0; person < kPeople; ++person) {
      const double bias = 2 * normal();
      std::vector<double> truth, found;
      for (int f = 0; f < kFrames; ++f) {
        truth.push_back(20 * std::sin(0.2 * f));
        found.push_back(truth.back() + bias + normal());
      }
      pairs.push_back(SumsOf(truth, found));
      units.push_back(std::to_string(100 + person));
    }
    const CurveAgreement agreement = MeasureAgreement(pairs, units, 1, std::to_string(study));
    ASSERT_TRUE(agreement.bias.interval && agreement.icc.interval && agreement.low.interval);
    covered += agreement.bias.interval->low <= 0 && agreement.bias.interval->high >= 0;
    // The control: an interval that treats all frames as independent has a half width of 1.96 √(5 / 600).
    too_narrow += std::abs(*agreement.bias.value) > 1.96 * std::sqrt(5.0 / (kPeople * kFrames));
    high += *agreement.high.value / kStudies;
  }
  EXPECT_GE(covered, kStudies * 0.82);
  EXPECT_GE(too_narrow, kStudies / 2);
  EXPECT_NEAR(high, 1.96 * std::sqrt(5.0), 0.4);
}

}  // namespace
}  // namespace etude
