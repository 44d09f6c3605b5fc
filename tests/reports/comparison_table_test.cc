#include "reports/comparison_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "reports/words/figures.h"
#include "tests/reports/support/count_of.h"
#include "tests/reports/support/example_run.h"
#include "tests/reports/support/unit_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ScenarioSummary ComparedTransition() { return ExampleRun().scenarios[0]; }

TEST(ComparisonTable, ShowsPairsDifferencePEffectVerdictAndWhatToMind) {
  const std::string html = ComparisonTableHtml(ComparedTransition());
  EXPECT_THAT(html, HasSubstr(">jump at the transition point (lower is better, 1 cm matters)</th>"));
  EXPECT_THAT(html, HasSubstr("<td>fuzzy-bridge − now</td><td class=\"n\" data-v=\"-19.1\">−19.1 cm</td>"
                              "<td class=\"n\" data-v=\"-30.1\">−30.1 to −8.1</td>"));
  EXPECT_THAT(html, HasSubstr("\">10 of 12</td><td class=\"n more\" data-v=\"0.0117\">0.012</td>"
                              "<td class=\"n more\" data-v=\"0.82\">+0.82</td>"));
  EXPECT_THAT(html, HasSubstr("<tr data-ids=\"transition/-/000/fuzzy-bridge\ntransition/-/000/now\">"));
  EXPECT_THAT(html, HasSubstr("2 of 12 worlds have no pair &lt;script&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("<script>")));
  EXPECT_THAT(html, HasSubstr("Holm’s correction over the 2 comparisons with baselines"));
}

TEST(ComparisonTable, CountsTheComparisonsOfEachCorrection) {
  ScenarioSummary scenario = ExampleRun().scenarios[0];
  scenario.conditions[0].rivals.assign(3, scenario.conditions[0].comparisons[0]);
  EXPECT_THAT(
      ComparisonTableHtml(scenario),
      HasSubstr("Holm’s correction over the 2 comparisons with baselines, and separately over the 3 comparisons with "
                "the strongest"));
}

TEST(ComparisonTable, SaysWhyAVerdictIsOpenAndMarksAnIntervalThatIsNoBca) {
  ScenarioSummary scenario = ComparedTransition();
  Comparison& comparison = scenario.conditions[0].comparisons[0];
  comparison.why_open = "too few worlds";
  comparison.interval = IntervalKind::kPercentile;
  const std::string html = ComparisonTableHtml(scenario);
  EXPECT_THAT(html, HasSubstr("</span><small>too few worlds</small></td>")) << "beside the verdict, not in a tooltip";
  EXPECT_THAT(html, HasSubstr(" †</td>"));
  EXPECT_THAT(ComparisonTableHtml(ComparedTransition()), Not(HasSubstr(" †</td>")));
  EXPECT_THAT(ComparisonTableMarkdown(scenario), HasSubstr("too few worlds"));
}

TEST(ComparisonTable, PutsADashWhereNothingCouldBeCompared) {
  ScenarioSummary scenario = ComparedTransition();
  Comparison nothing;
  nothing.metric = "jump_cm";
  nothing.baseline = "now";
  nothing.method = "fuzzy-bridge";
  nothing.neither = 12;
  scenario.conditions[0].comparisons = {nothing};
  EXPECT_THAT(ComparisonTableHtml(scenario), HasSubstr("data-v=\"\">—</td><td class=\"n\" data-v=\"\">—</td>"));
  EXPECT_THAT(ComparisonTableCsv(scenario),
              HasSubstr("fuzzy-bridge,0,0,0,0,12,,,,none,,,,,,,,,,,undecided,,baseline,clip-pair,0,,,,,,,,\n"));
  scenario.conditions[0].comparisons.clear();
  EXPECT_EQ(ComparisonTableHtml(scenario), "");
  EXPECT_EQ(ComparisonTableMarkdown(scenario), "");
}

TEST(ComparisonTable, HasAsManyCellsInEveryRowOfTheCsv) {
  ScenarioSummary scenario = ComparedTransition();
  for (Comparison& comparison : scenario.conditions[0].comparisons) comparison.notes = {"no comma here"};
  const std::string csv = ComparisonTableCsv(scenario);
  const auto commas = std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
  const auto lines = std::count(csv.begin(), csv.end(), '\n');
  EXPECT_EQ(lines, 1 + 8);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), commas * lines);
}

TEST(FormatP, NeverSaysZero) {
  EXPECT_EQ(FormatP(0.42), "0.42");
  EXPECT_EQ(FormatP(0.0123), "0.012");
  EXPECT_EQ(FormatP(1e-12), "< 0.001");
  EXPECT_EQ(FormatP(std::nullopt), kNoValue);
}

TEST(ComparisonTable, GivesBothVerdictsAndTheStrongestOtherMethod) {
  const RunData run = UnitRun();
  const std::string html = ComparisonTableHtml(run.scenarios[3]);
  EXPECT_THAT(html,
              HasSubstr("<th scope=\"col\">Verdict on these clips</th><th scope=\"col\">Verdict for other clips</th>"));
  EXPECT_THAT(html, HasSubstr("<td>—<small>4 clips, 6 are needed</small></td>"));
  const std::string csv = ComparisonTableCsv(run.scenarios[0]);
  EXPECT_THAT(csv, HasSubstr(",rival,clip-pair,8,"));
  EXPECT_THAT(ComparisonTableMarkdown(run.scenarios[0]), HasSubstr("(strongest other) |"));
}

TEST(ComparisonTable, TellsOfNoPairTwice) {
  ScenarioSummary scenario = ComparedTransition();
  const std::size_t all = scenario.conditions[0].comparisons.size();
  ASSERT_EQ(CountComparisons(scenario), all);
  Comparison again = scenario.conditions[0].comparisons[0];
  scenario.conditions[0].rivals = {again};
  EXPECT_EQ(CountComparisons(scenario), all);
  std::swap(again.method, again.baseline);  // the same pair with its methods exchanged
  scenario.conditions[0].rivals.push_back(again);
  EXPECT_EQ(CountComparisons(scenario), all);
  again.method = "another";
  scenario.conditions[0].rivals.push_back(again);
  EXPECT_EQ(CountComparisons(scenario), all + 1);
  const std::string html = ComparisonTableHtml(scenario);
  EXPECT_EQ(CountOf(html, "<tr data-ids="), static_cast<int>(all) + 1);
  EXPECT_THAT(html, HasSubstr(" more comparisons, by the other metrics</summary>"));
}

/// Returns one comparison's verdicts under two laws, and the common verdict.
AcrossVerdict Said(Verdict under_power, Verdict under_two_rate, Verdict together) {
  AcrossVerdict across{.condition = {{"noise", "1"}}, .metric = "retention", .method = "oracle"};
  across.baseline = "a<b";
  across.each = {{"learning=power", under_power, 0.031}, {"learning=two-rate", under_two_rate, {}}};
  across.verdict = together;
  return across;
}

ScenarioSummary ScenarioOf(std::vector<AcrossVerdict> verdicts) {
  ScenarioSummary scenario{.across = std::move(verdicts)};
  return scenario;
}

TEST(AcrossTable, IsLeftOutWhereNothingWasAsked) {
  EXPECT_EQ(AcrossTableHtml(ScenarioOf({})), "");
  EXPECT_EQ(AcrossTableMarkdown(ScenarioOf({})), "");
}

TEST(AcrossTable, TellsWhatHoldsAndElseWhyNot) {
  using enum Verdict;
  const auto text = [](Verdict power, Verdict two_rate, Verdict together) {
    return AcrossTableMarkdown(ScenarioOf({Said(power, two_rate, together)}));
  };
  EXPECT_THAT(text(kBetter, kBetter, kBetter), HasSubstr("better: holds |"));
  EXPECT_THAT(text(kNoDifference, kNoDifference, kNoDifference), HasSubstr("no difference: holds |"));
  EXPECT_THAT(text(kBetter, kWorse, kUndecided),
              HasSubstr("undecided: better under some values, worse under others |"));
  EXPECT_THAT(text(kBetter, kUndecided, kUndecided), HasSubstr("undecided: does not hold under all values |"));
  EXPECT_THAT(text(kUndecided, kUndecided, kUndecided), HasSubstr("undecided under all values |"));
}

TEST(AcrossTable, NamesEveryLawWithItsDifferenceWhereThereIsOne) {
  const std::string html =
      AcrossTableHtml(ScenarioOf({Said(Verdict::kBetter, Verdict::kUndecided, Verdict::kUndecided)}));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">learning=power</th><th scope=\"col\">learning=two-rate</th>"));
  EXPECT_THAT(html, HasSubstr("<td>3.10 pp better</td><td>undecided</td>"));
  EXPECT_THAT(html, HasSubstr("<td>oracle − a&lt;b</td>"));
  EXPECT_THAT(html, Not(HasSubstr("a<b")));
}

TEST(AcrossTable, HasAsManyCellsInEveryRow) {
  const AcrossVerdict said = Said(Verdict::kBetter, Verdict::kBetter, Verdict::kBetter);
  std::istringstream lines(AcrossTableMarkdown(ScenarioOf({said, said, said})));
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|")) continue;
    EXPECT_EQ(std::ranges::count(line, '|'), 7) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 5);  // headings, a rule, three comparisons
}

}  // namespace
}  // namespace etude
