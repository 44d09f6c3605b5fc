#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/plots/plot_section.h"
#include "tests/reports/support/count_of.h"
#include "tests/reports/support/example_run.h"
#include "tests/reports/support/unit_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Returns a comparison by its index; comparisons are sorted by method, then by metric.
Judged JudgedIn(const ScenarioSummary& scenario, std::size_t index) {
  return {&scenario.conditions[0].comparisons[index], &scenario.conditions[0]};
}

TEST(PairedDots, AreThoseInWhichBothHaveAValue) {
  const RunData run = UnitRun();
  const ScenarioSummary& capture = run.scenarios[3];  // ccd-fixed fails in trial 0
  const PairedDots pairs = PairedWorldsOf(run, capture, JudgedIn(capture, 0));
  ASSERT_EQ(pairs.worlds.size(), 11u);
  EXPECT_EQ(pairs.worlds.front().trial, 1);
  EXPECT_EQ(pairs.units, (std::vector<std::string>{"clip-0", "clip-1", "clip-2", "clip-3"}));
  for (const PairedWorld& world : pairs.worlds) {
    EXPECT_EQ(world.unit, static_cast<std::size_t>(world.trial % 4));
    EXPECT_NEAR(world.Difference(), (64.0 - 71.4) * (0.8 + 0.4 * world.trial / 11), 1e-9);
  }
}

TEST(PairedDots, AreThinnedAndCounted) {
  RunData run = UnitRun();
  const ScenarioSummary& detection = run.scenarios[1];
  std::vector<Row> more;
  for (const Row& row : run.rows) {
    for (int i = 1; row.scenario == "detection" && i < 100; ++i) {
      more.push_back(row);
      more.back().trial += 12 * i;
    }
  }
  run.rows.insert(run.rows.end(), more.begin(), more.end());
  const PairedDots pairs = PairedWorldsOf(run, detection, JudgedIn(detection, 0));
  EXPECT_EQ(pairs.total, 1200u);
  EXPECT_EQ(pairs.worlds.size(), 400u);
  EXPECT_THAT(EstimationHtml(detection, JudgedIn(detection, 0), pairs),
              HasSubstr("(400 of 1,200 worlds are drawn, at equal steps)"));
}

TEST(PairedDots, OfARivalThatHalvesChoseAreNone) {
  RunData run = UnitRun();
  run.scenarios[3].conditions[0].comparisons[0].baseline = "before-ik or ccd-adaptive";
  EXPECT_TRUE(PairedWorldsOf(run, run.scenarios[3], JudgedIn(run.scenarios[3], 0)).worlds.empty());
  EXPECT_EQ(EstimationHtml(run.scenarios[3], JudgedIn(run.scenarios[3], 0), {}), "");
}

TEST(Estimation, DrawsEveryWorldTwiceAndItsDifferenceOnce) {
  const RunData run = UnitRun();
  const ScenarioSummary& capture = run.scenarios[3];
  const PairedDots pairs = PairedWorldsOf(run, capture, JudgedIn(capture, 2));
  const std::string html = EstimationHtml(capture, JudgedIn(capture, 2), pairs);
  EXPECT_EQ(CountOf(html, "data-t=\"5\""), 3);
  EXPECT_EQ(CountOf(html, " data-t="), static_cast<int>(3 * pairs.worlds.size()));
  EXPECT_THAT(html, HasSubstr("<title>trial 5 · clip-1: "));
  EXPECT_THAT(html, HasSubstr("class=\"band\""));
  EXPECT_THAT(EstimationLegend(capture, "mpjpe_mm"),
              HasSubstr("Shaded: differences of less than 1 mm, which do not matter"));
  EXPECT_THAT(html, HasSubstr("data-s=\"capture\" data-c=\"-\" data-a=\"before-ik\" data-b=\"ccd-adaptive\""));
  EXPECT_THAT(UnitLegendHtml(pairs), HasSubstr("clip-3"));
}

TEST(Estimation, ColoursByMethodWhereWorldsAreUnits) {
  const RunData run = UnitRun();
  const ScenarioSummary& ik = run.scenarios[2];
  const PairedDots pairs = PairedWorldsOf(run, ik, JudgedIn(ik, 0));
  EXPECT_TRUE(pairs.units.empty());
  EXPECT_EQ(UnitLegendHtml(pairs), "");
  const std::string html = EstimationHtml(ik, JudgedIn(ik, 0), pairs);
  EXPECT_THAT(EstimationLegend(ik, "orientation_error_deg"), HasSubstr("coloured by method"));
  EXPECT_EQ(CountOf(html, "class=\"f0\""), 12);      // the baseline, once per world
  EXPECT_EQ(CountOf(html, "class=\"f1\""), 2 * 12);  // the method, and its differences
}

TEST(Estimation, LetsNoNameSpeakMarkup) {
  RunData run = UnitRun();
  ScenarioSummary& capture = run.scenarios[3];
  const std::string hostile = "\"><script>alert(1)</script>";
  for (Row& row : run.rows) {
    if (row.method == "ccd-adaptive") row.method = hostile;
    for (std::string& unit : row.units) unit = hostile + unit;
  }
  capture.methods[2] = capture.conditions[0].comparisons[2].method = hostile;
  capture.conditions[0].methods[2].method = hostile;
  EXPECT_THAT(PlotSectionHtml(run, capture), Not(HasSubstr("<script>")));
}

TEST(Strips, ShowEveryMethodsDistributionWithItsMiddle) {
  const RunData run = UnitRun();
  const ScenarioSummary& capture = run.scenarios[3];
  const std::string html = StripsHtml(run, capture, capture.conditions[0], "mpjpe_mm");
  EXPECT_EQ(CountOf(html, "class=\"typical\""), 3);
  EXPECT_EQ(CountOf(html, "<use "), 12 + 11 + 11);
  EXPECT_THAT(html, HasSubstr(">before-ik 71.4</text>"));
  EXPECT_EQ(StripsHtml(run, capture, capture.conditions[0], "sparc"), "");
}

TEST(PlotSection, BeginsWithTheQuestionAndDrawsNoPairTwice) {
  const RunData run = UnitRun();
  const std::string html = PlotSectionHtml(run, run.scenarios[0]);
  const auto place = [&](const char* other, const char* method) {
    const std::string pair = std::string("data-a=\"") + other + "\" data-b=\"" + method + "\"";
    EXPECT_LE(CountOf(html, pair), static_cast<int>(run.scenarios[0].headline_metrics.size())) << pair;
    return html.find(pair);
  };
  EXPECT_LT(place("now", "wait-for-end"), place("gate-inertialised", "wait-for-end"));
  EXPECT_LT(place("gate-inertialised", "wait-for-end"), place("now", "fuzzy-bridge"));
  EXPECT_EQ(CountOf(html, "which do not matter"), 2);  // once per metric
  EXPECT_EQ(PlotSectionHtml(run, ScenarioSummary{}), "");
}

TEST(LeadPicture, IsOfTheConditionWithTheLargestDifference) {
  const RunData run = ExampleRun();
  ScenarioSummary ik = run.scenarios[2];
  for (std::size_t i = 0; i < ik.conditions.size(); ++i) {
    for (Comparison& c : ik.conditions[i].comparisons) c.difference = i == 1 ? -9 : -1;
  }
  const std::string label = CompactLabel(ik.conditions[1].condition);
  EXPECT_THAT(LeadPictureHtml(run, ik), HasSubstr("data-c=\"" + label + "\""));
  EXPECT_EQ(CountOf(LeadPictureHtml(run, ik), "<figure"), 1);
  EXPECT_THAT(PlotSectionHtml(run, ik),
              Not(HasSubstr("<figure class=\"worlds\" data-s=\"" + ik.name + "\" data-c=\"" + label +
                            "\"><figcaption>" + ConditionLabel(ik.conditions[1].condition) + ": effector")));
}

TEST(Dots, CarryTheNameOfARecordedCell) {
  RunData run = UnitRun();
  const ScenarioSummary& capture = run.scenarios[3];
  EXPECT_THAT(PlotSectionHtml(run, capture) + LeadPictureHtml(run, capture), Not(HasSubstr("data-cell")));
  run.recordings.push_back({"capture/-/005/ccd-adaptive", {}});
  EXPECT_EQ(CountOf(LeadPictureHtml(run, capture), "data-t=\"5\" data-cell=\"capture/-/005/ccd-adaptive\""), 1);
  const std::string html =
      EstimationHtml(capture, JudgedIn(capture, 2), PairedWorldsOf(run, capture, JudgedIn(capture, 2)));
  EXPECT_EQ(CountOf(html, "data-cell=\"capture/-/005/ccd-adaptive\""), 2);  // its value, and its difference
}

using ::testing::EndsWith;

/// Returns a difference of mpjpe_mm (threshold 1 mm) with and without each of three clips.
Comparison Differing(double all, std::vector<double> without) {
  Comparison c;
  c.metric = "mpjpe_mm";
  c.method = "adaptive";
  c.baseline = "fixed";
  c.beyond.mean = all;
  const char* names[] = {"a", "b", "<c>"};
  for (std::size_t i = 0; i < without.size(); ++i) c.beyond.left_out.push_back({names[i], without[i]});
  return c;
}

TEST(LeftOutStrip, NamesTheClipThatCarriesTheDifference) {
  EXPECT_EQ(WithoutEachUnit(Differing(-4, {-0.3, -5, -6.7}), SamplingUnit::kClip),
            "“adaptive” against “fixed”: if each clip in turn is left out, the mean difference is from −6.70 mm to "
            "−0.300 mm. "
            "Without “a”, the mean difference is −0.300 "
            "mm: the difference depends on this clip.");
  // "a" is nearer to the whole than "c", but crosses the threshold, so "a" is named.
  EXPECT_THAT(WithoutEachUnit(Differing(2.4, {0.7, 2.2, 9}), SamplingUnit::kClip),
              HasSubstr("Without “a”, the mean difference is 0.700 mm"));
  EXPECT_THAT(WithoutEachUnit(Differing(-2, {1.5, -3, -4}), SamplingUnit::kLibrary),
              EndsWith("the difference depends on this library."));
}

TEST(LeftOutStrip, SaysThatNoneCarriesIt) {
  EXPECT_THAT(
      WithoutEachUnit(Differing(-4, {-3, -4, -5}), SamplingUnit::kClip),
      EndsWith("Without “a”, the mean difference is −3.00 mm: no single clip decides whether the difference matters."));
  EXPECT_THAT(WithoutEachUnit(Differing(0.2, {0.1, -0.3, 0.4}), SamplingUnit::kLibrary),
              EndsWith("no single library decides whether the difference matters."));
}

TEST(LeftOutStrip, NamesTheClipThatHidesOne) {
  EXPECT_THAT(WithoutEachUnit(Differing(0.2, {0.1, -3, 0.5}), SamplingUnit::kClip),
              EndsWith("without this clip, the difference would matter."));
}

TEST(LeftOutStrip, DrawsAMarkPerClipAgainstWhatMatters) {
  const std::string html = LeftOutStripHtml(Differing(-4, {-0.3, -5, -6.7}), SamplingUnit::kClip);
  EXPECT_EQ(CountOf(html, "class=\"left"), 1 + 3);  // the figure, and a line for each clip
  EXPECT_EQ(CountOf(html, "class=\"left extreme\""), 1);
  EXPECT_THAT(html, HasSubstr("without &lt;c&gt;: −6.70 mm"));
  EXPECT_THAT(html, HasSubstr("class=\"band\""));
}

TEST(LeftOutStrip, IsNotDrawnWhereWorldsAreUnits) {
  EXPECT_EQ(LeftOutStripHtml(Differing(-4, {}), SamplingUnit::kWorld), "");
  EXPECT_EQ(LeftOutStripHtml(Comparison{}, SamplingUnit::kClip), "");
}

}  // namespace
}  // namespace etude
