#include "bench/statistics/beyond.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/random/stream.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const MetricInfo& Metric() { return *FindMetric("mpjpe_mm"); }  // lower is better, threshold 1 mm

/// Returns a sample in which each world belongs to one unit. Unit i has `worlds_each` worlds, whose differences are in
/// steps of 1 around means[i].
UnitSample OneWay(const std::vector<double>& means, int worlds_each = 3) {
  UnitSample sample;
  for (std::size_t unit = 0; unit < means.size(); ++unit) {
    sample.names.push_back("clip-" + std::string(1, static_cast<char>('a' + unit)));
    for (int i = 0; i < worlds_each; ++i) {
      sample.differences.push_back(means[unit] + (i - (worlds_each - 1) / 2.0));
      sample.units.push_back({static_cast<int>(unit)});
    }
  }
  return sample;
}

Beyond Judged(const UnitSample& sample, int comparisons = 1) {
  Beyond beyond = MeasureBeyond(sample, comparisons);
  beyond.p_holm = beyond.test.p;
  beyond.verdict = VerdictBeyond(beyond, Metric());
  beyond.why_open = WhyOpenBeyond(beyond, Metric(), SamplingUnit::kClip, comparisons);
  return beyond;
}

TEST(MeasureBeyond, IsThePseudoMedianOfTheUnitsMeansAndShowsStudentsIntervalOfTheirMean) {
  // scipy.stats.ttest_1samp([-4, -6, -5, -9, -3, -7, -8], 0).confidence_interval(): −7.9979, −4.0021
  const Beyond beyond = Judged(OneWay({-4, -6, -5, -9, -3, -7, -8}));
  EXPECT_EQ(beyond.units, 7);
  EXPECT_DOUBLE_EQ(*beyond.difference, -6);
  EXPECT_DOUBLE_EQ(*beyond.low, -8);  // R: wilcox.test(-3:-9, conf.int = TRUE)
  EXPECT_DOUBLE_EQ(*beyond.high, -4);
  EXPECT_DOUBLE_EQ(*beyond.mean, -6);
  EXPECT_NEAR(*beyond.mean_low, -7.997895, 1e-6);
  EXPECT_NEAR(*beyond.mean_high, -4.002105, 1e-6);
  EXPECT_DOUBLE_EQ(*beyond.test.p, 2.0 / 128) << "all seven signs agree";
  EXPECT_EQ(beyond.verdict, Verdict::kBetter);
}

TEST(MeasureBeyond, CountsUnitsAndNotWorlds) {
  const Beyond few = Judged(OneWay({-4, -6, -5, -9}, 300));
  EXPECT_EQ(few.units, 4);
  EXPECT_FALSE(few.verdict);
  EXPECT_DOUBLE_EQ(*few.mean, -6);
  EXPECT_FALSE(few.low);
  EXPECT_FALSE(few.test.p);
  EXPECT_EQ(few.left_out.size(), 4u) << "does one clip carry it?";
  EXPECT_EQ(few.why_open, "4 clips: no verdict for others; at least 6 are needed");
  EXPECT_EQ(*Judged(OneWay({-4, -6, -5, -9, 3, 2}, 1)).low, *Judged(OneWay({-4, -6, -5, -9, 3, 2}, 99)).low);
}

TEST(MeasureBeyond, TakesTheTTestWhereSignsCannotReachFivePercent) {
  const std::vector<double> means = {-4, -6, -5, -9, -3, -7};
  EXPECT_THAT(Judged(OneWay(means)).test.how, HasSubstr("signed ranks"));
  const Beyond among_two = Judged(OneWay(means), 2);  // 2⁻⁵ × 2 > 0.05
  EXPECT_EQ(among_two.test.how, "t test of units' means");
  EXPECT_NEAR(*among_two.test.p, 0.0013559, 1e-6);  // scipy.stats.ttest_1samp
}

TEST(MeasureBeyond, ShowsWhichUnitCarriesTheDifference) {
  const Beyond beyond = Judged(OneWay({0, 0, 0, 0, 0, -60}));
  ASSERT_EQ(beyond.left_out.size(), 6u);
  EXPECT_DOUBLE_EQ(beyond.left_out[0].difference, -12);
  EXPECT_EQ(beyond.left_out[5].unit, "clip-f");
  EXPECT_DOUBLE_EQ(beyond.left_out[5].difference, 0);
  EXPECT_EQ(beyond.verdict, Verdict::kUndecided);
}

TEST(MeasureBeyond, ClaimsNothingThatTheMeanContradicts) {
  std::vector<double> means;
  for (int i = 0; i < 20; ++i) means.push_back(-1.5 - 0.02 * i);
  EXPECT_EQ(Judged(OneWay(means)).verdict, Verdict::kBetter);
  means.push_back(60);  // this clip is far worse, and its mean outweighs the twenty others
  const Beyond beyond = Judged(OneWay(means));
  EXPECT_LT(*beyond.high, -1);
  EXPECT_LE(*beyond.test.p, 0.01);
  EXPECT_GT(*beyond.mean, 0);
  EXPECT_EQ(beyond.verdict, Verdict::kUndecided);
  EXPECT_THAT(beyond.why_open, HasSubstr("few units outweigh the others"));
}

TEST(MeasureBeyond, SaysNoDifferenceOnlyOfUnitsThatDiffer) {
  EXPECT_EQ(Judged(OneWay({0.1, -0.1, 0.2, -0.2, 0.1, -0.1, 0.05})).verdict, Verdict::kNoDifference);
  const Beyond equal = Judged(OneWay({0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(equal.verdict, Verdict::kUndecided);
  EXPECT_THAT(equal.why_open, HasSubstr("0 of 8 clips differ"));
  // The adjusted Wald interval is for shares, so it does not apply to millimetres. It adds one gain and one loss to
  // these 8 units, so their mean has the variance (0.1 + 0.1) / 10.
  EXPECT_EQ(std::pair(*equal.low, *equal.high), std::pair(0.0, 0.0));
  UnitSample shares = OneWay({0, 0, 0, 0, 0, 0, 0, 0}, 1);
  shares.yes_or_no = true;
  EXPECT_NEAR(*MeasureBeyond(shares, 1).high, 1.96 * std::sqrt(0.2 / 10), 1e-3);  // Bonett and Price
}

/// Returns each pair of clips once; a pair's difference is the sum of its clips' effects.
UnitSample TwoWay(const std::vector<double>& effects) {
  UnitSample sample;
  for (std::size_t a = 0; a < effects.size(); ++a) {
    sample.names.push_back("clip-" + std::string(1, static_cast<char>('a' + a)));
    for (std::size_t b = 0; b < effects.size(); ++b) {
      if (a == b) continue;
      sample.differences.push_back(effects[a] + effects[b]);
      sample.units.push_back({static_cast<int>(a), static_cast<int>(b)});
    }
  }
  return sample;
}

TEST(MeasureBeyond, LeavesOutAClipInWhateverPart) {
  const std::vector<double> effects = {-1, -3, -2, -5, -4, -3};
  const Beyond beyond = Judged(TwoWay(effects));
  const double sum = std::accumulate(effects.begin(), effects.end(), 0.0);
  EXPECT_DOUBLE_EQ(*beyond.difference, 2 * sum / 6);
  double squares = 0;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const double without = 2 * (sum - effects[i]) / 5;  // closed form of a complete design
    EXPECT_NEAR(beyond.left_out[i].difference, without, 1e-12);
    squares += (without - 2 * sum / 6) * (without - 2 * sum / 6);
  }
  const double half = 2.570582 * std::sqrt(5.0 / 6 * squares);  // t quantile, 5 degrees of freedom
  EXPECT_NEAR(*beyond.mean_high, 2 * sum / 6 + half, 1e-5);
  // A clip's estimate is twice its effect, because it counts both as the clip left and as the clip entered.
  EXPECT_DOUBLE_EQ(*beyond.low, -10);
  EXPECT_DOUBLE_EQ(*beyond.high, -2);
  EXPECT_EQ(beyond.test.how, "signed ranks of units, exact");
  EXPECT_EQ(beyond.verdict, Verdict::kBetter);
}

TEST(MeasureBeyond, KnowsNothingBeyondWhatEveryWorldShows) {
  const Beyond one = Judged(OneWay({-4}));
  EXPECT_EQ(one.units, 1);
  EXPECT_EQ(*one.difference, -4);
  EXPECT_TRUE(one.left_out.empty());
  EXPECT_FALSE(one.verdict);
  // In every world the transition leaves or enters clip 0.
  UnitSample sample = OneWay({0, -1, -3, -2, -5, -4, -3});
  for (std::vector<int>& units : sample.units) {
    if (units.front() != 0) units.push_back(0);
  }
  const Beyond always = Judged(sample);
  EXPECT_EQ(always.units, 7);
  EXPECT_EQ(always.left_out.size(), 6u);
  EXPECT_FALSE(always.verdict);
  EXPECT_EQ(always.why_open, "all worlds show the same clip: no verdict for other clips");
  EXPECT_EQ(Judged({}).units, 0);
}

/// Returns how many of 400 samples without an effect get a clear verdict.
int AlarmsBeyond(bool two_way, bool as_worlds) {
  MetricInfo metric = Metric();
  metric.practical = 1e-9;
  int alarms = 0;
  for (int i = 0; i < 400; ++i) {
    RandomStream dice({.suite_seed = 3, .scenario = "beyond", .trial = i}, "x");
    std::vector<double> effects(8);
    for (double& effect : effects) effect = dice.Normal(0, 3);
    UnitSample sample = two_way ? TwoWay(effects) : OneWay(effects);
    for (double& difference : sample.differences) difference += dice.Normal();
    if (as_worlds) {
      sample.names.assign(sample.differences.size(), "");
      for (std::size_t world = 0; world < sample.units.size(); ++world) {
        sample.names[world] = std::to_string(world);
        sample.units[world] = {static_cast<int>(world)};
      }
    }
    Beyond beyond = MeasureBeyond(sample, 1);
    beyond.p_holm = beyond.test.p;
    const auto verdict = VerdictBeyond(beyond, metric);
    alarms += verdict == Verdict::kBetter || verdict == Verdict::kWorse;
  }
  return alarms;
}

TEST(MeasureBeyond, SeldomFindsWhatTheClipsMadeUp) {
  EXPECT_LE(AlarmsBeyond(false, false), 30);
  EXPECT_LE(AlarmsBeyond(true, false), 30);
  // The controls: each world is treated as its own unit.
  EXPECT_GE(AlarmsBeyond(false, true), 80);
  EXPECT_GE(AlarmsBeyond(true, true), 160);
}

}  // namespace
}  // namespace etude
