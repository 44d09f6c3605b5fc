#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "io/drawing/escape.h"
#include "reports/comparison_table.h"
#include "reports/overview_table.h"
#include "reports/page.h"
#include "reports/words/figures.h"
#include "tests/reports/support/count_of.h"
#include "tests/reports/support/example_run.h"
#include "tests/reports/support/unit_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

/// Returns one condition's float, by its index.
std::string FloatOf(const std::string& latex, std::size_t index) {
  std::size_t at = 0;
  for (std::size_t i = 0; i <= index; ++i) at = latex.find("\\begin{table}", at + (i > 0));
  return latex.substr(at, latex.find("\\end{table}", at) - at);
}

TEST(ScenarioLatex, HoldsTheFiguresOfTheCsv) {
  const RunData run = ExampleRun();
  int checked = 0;
  for (const ScenarioSummary& scenario : run.scenarios) {
    const std::string latex = ScenarioLatex(run, scenario);
    const auto lines = Split(NumberTableCsv(run, scenario), '\n');
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const auto fields = Split(lines[i], ',');
      if (fields[3] == "ok_share") continue;
      std::size_t condition = 0;
      while (ConditionLabel(scenario.conditions[condition].condition) != fields[1]) ++condition;
      const MetricWords words = WordsFor(fields[3]);
      const std::string value = FormatValue(std::stod(fields[words.by_mean ? 8 : 5]), words);
      const std::string interval = FormatInterval(std::stod(fields[6]), std::stod(fields[7]), words);
      EXPECT_THAT(
          FloatOf(latex, condition),
          HasSubstr(EscapeLatex(fields[2]) + " & " + fields[9] +
                    (fields[10] == "0" ? "" : " of " + std::to_string(std::stoi(fields[9]) + std::stoi(fields[10]))) +
                    " & " + EscapeLatex(value + " [" + interval + "]")))
          << lines[i];
      ++checked;
    }
  }
  EXPECT_EQ(checked, 2 * (5 + 2 + 3 * 4 + 3));
}

TEST(ScenarioLatex, WritesEveryUnitAndLabelOfTheCatalogue) {
  EXPECT_EQ(EscapeLatex("m/s²"), "m/s$^2$");
  EXPECT_EQ(EscapeLatex("10⁻³ cm·s, …"), "10$^-$$^3$ cm$\\cdot$s, \\dots{}");
  for (const MetricInfo& metric : AllMetrics()) {
    for (const std::string& text : {metric.unit, WordsFor(metric.id).suffix, MetricHeading(metric.id)}) {
      EXPECT_THAT(EscapeLatex(text), Not(HasSubstr("[U+"))) << metric.id;
    }
  }
}

TEST(ScenarioLatex, SaysWhatAMethodLeftOut) {
  RunData run = ExampleRun();
  ScenarioSummary& scenario = run.scenarios[1];
  const auto success = std::ranges::find_if(AllMetrics(), &MetricInfo::is_success);
  std::vector<MethodSummary>& methods = scenario.conditions[0].methods;
  for (MethodSummary& method : methods) {
    std::erase_if(method.metrics, [&](const MetricSummary& metric) { return metric.id == success->id; });
    method.metrics.push_back({success->id, 12, 0, 1.0, 1.0, 1.0, 1.0});
  }
  std::erase(scenario.headline_metrics, success->id);
  const std::string heading = EscapeLatex(MetricHeading(success->id));
  EXPECT_THAT(ScenarioLatex(run, scenario), Not(HasSubstr(heading))) << "nothing is left out";
  methods.back().metrics.back().mean = 0.7;
  const std::string latex = ScenarioLatex(run, scenario);
  EXPECT_THAT(latex, HasSubstr(heading));
  EXPECT_THAT(latex, HasSubstr(methods.back().method + " & 12 & 70.0 \\% ["));
  EXPECT_THAT(OverviewTableMarkdown(scenario), HasSubstr(WordsFor(success->id).label));
}

TEST(ScenarioLatex, HasAFloatPerConditionThatEndsAsItBegan) {
  const RunData run = ExampleRun();
  const std::string latex = ScenarioLatex(run, run.scenarios[2]);
  for (const char* part : {"{table}", "{tabular}"}) {
    EXPECT_EQ(CountOf(latex, std::string("\\begin") + part), 3) << part;
    EXPECT_EQ(CountOf(latex, std::string("\\end") + part), 3) << part;
  }
  for (const std::string& line : Split(latex, '\n')) {
    if (!line.ends_with(" \\\\") || line.starts_with("\\multicolumn")) continue;
    // An escaped & does not separate columns.
    EXPECT_EQ(CountOf(line, "&") - CountOf(line, "\\&"), 7) << line;
  }
}

TEST(ScenarioLatex, GivesVerdictsWithMarksThatTheCaptionExplains) {
  RunData run = ExampleRun();
  Comparison& first = run.scenarios[2].conditions[0].comparisons[0];
  first.p_holm = 0.0004;
  run.scenarios[2].conditions[0].comparisons[2].p_holm = 0.2;
  const std::string table = FloatOf(ScenarioLatex(run, run.scenarios[2]), 0);
  EXPECT_THAT(table, HasSubstr("]$^{***}$ & \\textless{} 0.001 & better"));  // p of the first metric
  EXPECT_THAT(table, HasSubstr("]$^{*}$ & 0.012 & better"));
  EXPECT_THAT(table, HasSubstr("] & 0.20 & better"));
  EXPECT_THAT(table, HasSubstr("$^{***}$~$p \\le 0.001$"));
  EXPECT_THAT(table, HasSubstr("this scenario's 2 comparisons"));
}

TEST(ScenarioLatex, PutsADashForAMissingValueAndCountsIt) {
  RunData run = ExampleRun();
  MetricSummary& metric = run.scenarios[1].conditions[0].methods[0].metrics[1];
  metric = {metric.id, 0, 12, std::nullopt, std::nullopt, std::nullopt, std::nullopt};
  EXPECT_THAT(ScenarioLatex(run, run.scenarios[1]), HasSubstr("fixed & 0 of 12 & --- & & & & & \\\\\n"));
}

TEST(ScenarioLatex, LetsNoNameSpeakLatex) {
  RunData run = ExampleRun();
  const std::string hostile = "a_b&c%d$e#f{g}h~i^j\\input{k}";
  ScenarioSummary& scenario = run.scenarios[1];
  scenario.name = scenario.question = scenario.methods[1] = scenario.conditions[0].methods[1].method = hostile;
  scenario.conditions[0].condition = {{hostile, hostile}};
  for (Comparison& c : scenario.conditions[0].comparisons) c.method = c.baseline = hostile;
  const std::string latex = ScenarioLatex(run, scenario);
  EXPECT_THAT(latex, HasSubstr(EscapeLatex(hostile)));
  EXPECT_THAT(latex, Not(HasSubstr("\\input")));
  EXPECT_THAT(latex, Not(HasSubstr("c%d")));
}

TEST(ScenarioLatex, SplitsATableThatNoPageHolds) {
  RunData run = ExampleRun();
  ScenarioSummary& scenario = run.scenarios[1];
  std::vector<MethodSummary>& methods = scenario.conditions[0].methods;
  while (methods.size() < 30) methods.push_back(methods.back());
  const std::string latex = ScenarioLatex(run, scenario);
  EXPECT_EQ(CountOf(latex, "\\begin{table}"), 3);
  EXPECT_EQ(CountOf(latex, "(continued)"), 2);
}

TEST(ScenarioLatex, GivesBothVerdictsAndARowOfTheStrongestOtherMethod) {
  const RunData run = UnitRun();
  const std::string capture = ScenarioLatex(run, run.scenarios[3]);
  EXPECT_THAT(capture, HasSubstr("$p$ & on these clips & for other clips"));
  EXPECT_THAT(capture, HasSubstr("better & -- \\\\\n"));
  const std::string transition = ScenarioLatex(run, run.scenarios[0]);
  EXPECT_THAT(transition, HasSubstr("better & better \\\\\n"));
  EXPECT_THAT(transition, HasSubstr(" & & & gate-inertialised & "));
}

}  // namespace
}  // namespace etude
