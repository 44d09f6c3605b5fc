#include "reports/words/figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace etude {
namespace {

using ::testing::ContainsRegex;
using ::testing::StartsWith;

TEST(Figures, ShowAboutThreeSignificantDigits) {
  EXPECT_EQ(FormatNumber(12.345), "12.3");
  EXPECT_EQ(FormatNumber(1.2345), "1.23");
  EXPECT_EQ(FormatNumber(0.012345), "0.0123");
  EXPECT_EQ(FormatNumber(1284.4), "1,284");
  EXPECT_EQ(FormatNumber(-3.14159), "−3.14");
  EXPECT_EQ(FormatNumber(0), "0");
  EXPECT_EQ(FormatNumber(-7.5e-17), "0");
  EXPECT_EQ(FormatNumber(0.0000312), "3.1e-05");
  EXPECT_EQ(FormatNumber(-0.0000312), "−3.1e-05");
}

TEST(Figures, ThatAreNotFiniteAreNoNumbers) {
  EXPECT_EQ(FormatNumber(std::nan("")), kNoValue);
  EXPECT_EQ(FormatNumber(std::numeric_limits<double>::infinity()), kNoValue);
}

TEST(Figures, NeverShowAMinusBeforeARoundedZero) { EXPECT_EQ(FormatFixed(-0.004, 1), "0.0"); }

TEST(Figures, CountsAreGroupedByThousands) {
  EXPECT_EQ(FormatCount(999), "999");
  EXPECT_EQ(FormatCount(1284), "1,284");
  EXPECT_EQ(FormatCount(12345678), "12,345,678");
}

TEST(Figures, AShareIsWholeOnlyWhenNothingIsMissing) {
  EXPECT_EQ(FormatShare(60, 60), "100 %");
  EXPECT_EQ(FormatShare(9999, 10000), "99.9 %");
  EXPECT_EQ(FormatShare(1, 10000), "0.1 %");
  EXPECT_EQ(FormatShare(0, 10), "0 %");
  EXPECT_EQ(FormatShare(0, 0), kNoValue);
}

TEST(Figures, IntervalsHaveTheSameDigitsAtBothEnds) {
  const MetricWords plain{};
  EXPECT_EQ(FormatInterval(10.06, 14, plain), "10.1–14.0");
  EXPECT_EQ(FormatInterval(-1.25, 0.4, plain), "−1.25 to 0.40");
  EXPECT_EQ(FormatInterval(std::nullopt, 2, plain), kNoValue);
}

TEST(Figures, AnEndOfAnIntervalNeverLosesItsSign) {
  const MetricWords plain{};
  EXPECT_EQ(FormatInterval(-0.0031, 30.4, plain), "−0.0031 to 30.4");
  EXPECT_EQ(FormatInterval(-30.4, 2e-5, plain), "−30.4 to 2.0e-05");
  EXPECT_EQ(FormatInterval(0.04, 30.4, plain), "0.0400–30.4");
  EXPECT_EQ(FormatInterval(0, 30.4, plain), "0.0–30.4");
  // The text shows on which side of 0 each end lies, whatever the ends are.
  for (const double high : {0.02, 1.5, 30.4, 1234.0}) {
    for (double low = 1e-7; low < high; low *= 1.7) {
      EXPECT_THAT(FormatInterval(-low, high, plain), StartsWith("−")) << low << " " << high;
      EXPECT_THAT(FormatInterval(-high, low, plain), ContainsRegex("to .*[1-9]")) << low << " " << high;
    }
  }
}

TEST(Figures, ReadAsTheCatalogueSays) {
  const MetricWords angle = WordsFor("orientation_error_deg");
  EXPECT_EQ(FormatValue(12.3, angle), "12.3°");
  const MetricWords share = WordsFor("solved_practical");
  EXPECT_TRUE(share.is_share);
  EXPECT_EQ(FormatValue(0.51, share), "51.0 %");
  EXPECT_EQ(FormatValue(std::nullopt, share), kNoValue);
}

TEST(Figures, AMetricOutsideTheCatalogueKeepsItsName) {
  const MetricWords words = WordsFor("no_such_metric");
  EXPECT_EQ(words.label, "no_such_metric");
  EXPECT_EQ(words.direction, Direction::kNeither);
}

TEST(Figures, SayMeanWhereItIsOneAndShareOnlyOfYesAndNo) {
  EXPECT_EQ(WordsFor("f1").label, "mean F1");
  EXPECT_EQ(WordsFor("solved_practical").label, "share “solved (0.1 cm, 0.1°)”");
  EXPECT_EQ(WordsFor("frames_recovered").label, "mean share of frames recovered");
  EXPECT_EQ(WordsFor("seen_share").label, "mean share judged");
  EXPECT_EQ(WordsFor("skating_ratio@gmd").label, "mean skating ratio");
  EXPECT_EQ(WordsFor("skipped_share").label, "mean skipped share of the wanted clip");
  EXPECT_EQ(WordsFor("orientation_error_deg").label, "effector orientation error");
  for (const MetricInfo& metric : AllMetrics()) {
    const MetricWords words = WordsFor(metric.id);
    EXPECT_EQ(words.label.starts_with("share"), metric.reading == Reading::kYesNo) << metric.id;
    // Values shown in per cent lie in 0…1, so no threshold exceeds 1.
    if (!words.is_share) continue;
    EXPECT_LT(metric.practical, 1) << metric.id;
    EXPECT_EQ(words.difference_suffix, " percentage points") << metric.id;
  }
}

TEST(Figures, OfPenalisedCostsAreMeansAndNoPercentages) {
  const MetricWords cost = WordsFor("iterations_par2");
  EXPECT_FALSE(cost.is_share);
  EXPECT_EQ(FormatValue(400, cost), "400");
  MetricSummary summary{.median = 12, .mean = 206};
  EXPECT_EQ(TypicalValue(summary, cost), 206);
  EXPECT_EQ(TypicalValue(summary, WordsFor("iterations")), 12);
}

}  // namespace
}  // namespace etude
