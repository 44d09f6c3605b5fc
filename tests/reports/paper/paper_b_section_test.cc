#include "reports/paper/paper_b_section.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/page.h"
#include "tests/reports/support/count_of.h"
#include "tests/reports/support/effector_run.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PaperBSection, IsEmptyForAScenarioThatKeepsNoSuchSeries) {
  const RunData run = ExampleRun();
  for (const ScenarioSummary& scenario : run.scenarios) {
    EXPECT_FALSE(ShowsPaperB(run, scenario));
    EXPECT_EQ(PaperBHtml(run, scenario), "");
    EXPECT_EQ(PaperBMarkdown(run, scenario), "");
    EXPECT_EQ(PaperBLatex(run, scenario), "");
    EXPECT_EQ(PaperBCsv(run, scenario), "");
  }
  EXPECT_THAT(WritePage(run, {}), Not(HasSubstr(".printed")));
  EXPECT_THAT(WritePage(EffectorRun(), {}), HasSubstr(".printed"));
}

TEST(PaperBSection, ShowsTablesFoldedButForTheFirstAndThePapersOwnOnce) {
  const RunData run = EffectorRun();
  const std::string html = PaperBHtml(run, run.scenarios[2]);
  EXPECT_EQ(CountOf(html, "table 5.2: "), 3 * 2);
  EXPECT_EQ(CountOf(html, "<details open>"), 2);  // the curves, and the first trial's tables
  EXPECT_EQ(CountOf(html, "as printed in the paper"), 1);
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">28.292493</td>"));
  EXPECT_THAT(html, HasSubstr("<code>etude replay RUN --cell &#39;ik-weights/joint_noise_deg=5/000/"));
}

TEST(PaperBSection, SpeaksOfNoHiddenAnglesWhereNoneAreKept) {
  RunData run = EffectorRun();
  for (CellSeries& cell : run.series) {
    std::erase_if(cell.series, [](const Series& series) { return series.axis == "angle"; });
  }
  const std::string html = PaperBHtml(run, run.scenarios[2]);
  EXPECT_EQ(CountOf(html, "table 5.1: "), 3 * 2);
  EXPECT_THAT(html, Not(HasSubstr("R_shoulder")));
  EXPECT_THAT(html, Not(HasSubstr("no such axis")));
}

TEST(PaperBSection, HasSixteenPanelsPerConditionWithEveryMethodInEach) {
  const RunData run = EffectorRun();
  const std::string html = PaperBHtml(run, run.scenarios[2]);
  EXPECT_EQ(CountOf(html, "<figure>"), 3 * 16);
  // Per panel and method, a line for the first trial and one for the median; per condition, a key for each method.
  EXPECT_EQ(CountOf(html, "<polyline"), 3 * 16 * 4 * 2);
  EXPECT_EQ(CountOf(html, "class=\"linekey\""), 3 * 4);
  EXPECT_THAT(html, HasSubstr("<figcaption>head: position, cm</figcaption>"));
  EXPECT_THAT(html, HasSubstr("<figcaption>right foot: Z axis, degrees</figcaption>"));
  EXPECT_LT(html.size(), 1u << 20);
}

TEST(PaperBSection, OfOneTrialHasNoMedians) {
  RunData run = EffectorRun();
  std::erase_if(run.rows, [](const Row& row) { return row.trial > 0; });
  const std::string html = PaperBHtml(run, run.scenarios[2]);
  EXPECT_EQ(CountOf(html, "table 5.2: "), 3);
  EXPECT_THAT(html, Not(HasSubstr("median")));
  EXPECT_THAT(html, Not(HasSubstr("faint")));
}

TEST(PaperBSection, SurvivesHostileNames) {
  RunData run = EffectorRun();
  const std::string hostile = "<script>alert(1)</script>&\"' \\input{/etc/passwd} $%#_{}~^";
  for (Row& row : run.rows) {
    const std::string before = row.Id();
    if (row.method == "fixed") row.method = hostile;
    row.result.reason = hostile;
    for (CellSeries& cell : run.series) {
      if (cell.cell == before) cell.cell = row.Id();
    }
  }
  run.scenarios[2].methods[0] = hostile;
  EXPECT_THAT(PaperBHtml(run, run.scenarios[2]), Not(HasSubstr("<script>")));
  EXPECT_THAT(PaperBMarkdown(run, run.scenarios[2]), Not(HasSubstr("<script>")));
  EXPECT_THAT(PaperBLatex(run, run.scenarios[2]), Not(HasSubstr("\\input")));
}

TEST(PaperBSection, OpensEveryFloatThatItClosesAndKeepsThemShort) {
  const RunData run = EffectorRun();
  const std::string latex = PaperBLatex(run, run.scenarios[2]);
  // Each condition has twice 5 tables of errors, 5 in a float, and 4 and 8 tables of angles, at most 3 in a float.
  EXPECT_EQ(CountOf(latex, "\\begin{table}"), 3 * (1 + 2 + 1 + 3));
  EXPECT_EQ(CountOf(latex, "\\end{table}"), CountOf(latex, "\\begin{table}"));
  EXPECT_EQ(CountOf(latex, "\\begin{tabular}"), 3 * (5 + 4 + 5 + 8));
  EXPECT_EQ(CountOf(latex, "\\end{tabular}"), CountOf(latex, "\\begin{tabular}"));
}

TEST(PaperBSection, SaysTheSameFiguresEverywhere) {
  const RunData run = EffectorRun();
  const std::string figure = fmt::format("{:.6f}", OrientationError(2, 0, 3, 1));
  EXPECT_THAT(PaperBHtml(run, run.scenarios[2]), HasSubstr(figure));
  EXPECT_THAT(PaperBMarkdown(run, run.scenarios[2]), HasSubstr(figure));
  EXPECT_THAT(PaperBLatex(run, run.scenarios[2]), HasSubstr(figure));
  EXPECT_THAT(PaperBCsv(run, run.scenarios[2]),
              HasSubstr(fmt::format("ik-weights,joint_noise_deg=5,trial 0,(d) after adaptive,head,orientation error "
                                    "(degrees),Y,{}\n",
                                    OrientationError(2, 0, 3, 1))));
}

}  // namespace
}  // namespace etude
