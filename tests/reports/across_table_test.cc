#include "reports/comparison_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// What two laws say of one comparison, and what they say together.
AcrossVerdict Said(Verdict under_power, Verdict under_two_rate, Verdict together) {
  AcrossVerdict across;
  across.condition = {{"noise", "1"}};
  across.metric = "retention";
  across.method = "oracle";
  across.baseline = "a<b";
  across.each = {{"learning=power", under_power, 0.031}, {"learning=two-rate", under_two_rate, {}}};
  across.verdict = together;
  return across;
}

ScenarioSummary ScenarioOf(std::vector<AcrossVerdict> verdicts) {
  ScenarioSummary scenario;
  scenario.across = std::move(verdicts);
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
  EXPECT_THAT(text(kBetter, kWorse, kInconclusive), HasSubstr("inconclusive: turns round |"));
  EXPECT_THAT(text(kBetter, kInconclusive, kInconclusive), HasSubstr("inconclusive: does not hold everywhere |"));
  EXPECT_THAT(text(kInconclusive, kInconclusive, kInconclusive), HasSubstr("inconclusive everywhere |"));
}

TEST(AcrossTable, NamesEveryLawWithItsDifferenceWhereThereIsOne) {
  const std::string html =
      AcrossTableHtml(ScenarioOf({Said(Verdict::kBetter, Verdict::kInconclusive, Verdict::kInconclusive)}));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">learning=power</th><th scope=\"col\">learning=two-rate</th>"));
  EXPECT_THAT(html, HasSubstr("<td>3.10 pp better</td><td>inconclusive</td>"));
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
  EXPECT_EQ(rows, 5);  // headings, rule, three comparisons
}

}  // namespace
}  // namespace etude
