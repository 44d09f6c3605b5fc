#include "reports/paper/paper_a.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/support/count_of.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ScenarioSummary Bridging() {
  ScenarioSummary scenario{.name = "paper-bridging", .task = "transition", .conditions = {ConditionSummary{}}};
  return scenario;
}

TEST(PaperAFigures, TellOfEveryEquationOnceAndOfEveryTerm) {
  std::vector<int> equations;
  int number = 5;
  for (const PaperAFigure& figure : PaperAFigures()) {
    EXPECT_EQ(figure.number, number++);
    EXPECT_EQ(figure.equations.size(), TermsOf(figure.feature).size());
    equations.insert(equations.end(), figure.equations.begin(), figure.equations.end());
  }
  std::ranges::sort(equations);
  EXPECT_THAT(equations, ::testing::ElementsAre(2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16));
}

// Posture's grades sum to 1, so the height method is exact. The paper's arm has grade 1 from 0 to 20 degrees, so
// information is lost.
TEST(PaperAFigures, MeasureWhatGoingBackCosts) {
  EXPECT_NEAR(MeanRoundTripError(Feature::kPosture, PaperMemberships(), Defuzzification::kHeight), 0, 1e-9);
  EXPECT_GT(MeanRoundTripError(Feature::kRH, PaperMemberships(), Defuzzification::kHeight), 1);
}

TEST(MembershipPlot, DrawsALinePerTermThroughItsBends) {
  const std::string svg = MembershipPlotSvg(Feature::kRH, PaperMemberships(), "arms");
  EXPECT_EQ(CountOf(svg, "<polyline"), 3);
  for (const char* text : {">down<", ">mid<", ">up<", ">0<", ">20<", ">90<", ">180<"})
    EXPECT_THAT(svg, HasSubstr(text));
  // x = 24 + 206 · 20/180 = 46.9 and 24 + 206 · 90/180 = 127; y = 22 at grade 1 and 118 at grade 0.
  for (const char* point : {"46.9,22.0", "127.0,22.0", "127.0,118.0"}) EXPECT_THAT(svg, HasSubstr(point));
}

TEST(PaperASection, ShowsThePapersSixFiguresForItsOwnScenario) {
  const std::string html = PaperAHtml(Bridging());
  EXPECT_EQ(CountOf(html, "<figure>"), 6);
  for (int number = 5; number <= 10; ++number) EXPECT_THAT(html, HasSubstr("<b>Figure " + std::to_string(number)));
  EXPECT_THAT(html, HasSubstr("equations 2 to 4"));
  EXPECT_EQ(CountOf(PaperAMarkdown(Bridging()), "| "), 5 * (15 + 1));
  EXPECT_THAT(PaperAMarkdown(Bridging()), HasSubstr("triangular: "));
  EXPECT_THAT(PaperALatex(Bridging()), HasSubstr("\\toprule"));
}

TEST(PaperASection, ShowsSweptSystemsBesideIt) {
  ScenarioSummary scenario = Bridging();
  scenario.name = "shapes";
  EXPECT_FALSE(ShowsPaperA(scenario)) << "the control";
  scenario.conditions = {
      {.condition = {{"fuzzy", "builtin:paper"}}, .methods = {}, .comparisons = {}, .rivals = {}},
      {.condition = {{"fuzzy", "builtin:gaussian"}}, .methods = {}, .comparisons = {}, .rivals = {}}};
  const std::string html = PaperAHtml(scenario);
  EXPECT_EQ(CountOf(html, "<figure>"), 12);
  EXPECT_THAT(html, HasSubstr("in the fuzzy system gaussian"));
}

TEST(PaperASection, IsEmptyForOtherScenarios) {
  ScenarioSummary scenario = Bridging();
  scenario.task = "ik";
  EXPECT_EQ(PaperAHtml(scenario), "");
  EXPECT_EQ(PaperAMarkdown(scenario), "");
  EXPECT_EQ(PaperALatex(scenario), "");
}

}  // namespace
}  // namespace etude
