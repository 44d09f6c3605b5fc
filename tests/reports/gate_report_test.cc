#include "reports/gate_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/gate_table.h"

namespace etude {
namespace {

using testing::HasSubstr;
using testing::Not;

MetricMove MoveOf(const std::string& method, const std::string& metric, Movement movement, double before,
                  double after) {
  MetricMove move;
  move.identity = {"ik-weights", "joint_noise_deg=5", method, metric};
  move.movement = movement;
  move.worlds = 60;
  move.differing = movement == Movement::kSame ? 0 : 12;
  move.before = before;
  move.after = after;
  move.comparison.difference = after - before;
  move.comparison.p_holm = 1e-5;
  move.comparison.ci_low = after - before - 0.5;
  move.comparison.ci_high = after - before + 0.5;
  return move;
}

GateReport Example() {
  GateReport report;
  report.suite = "quick";
  report.baseline_file = "quick.json";
  report.baseline_version = "1.0";
  report.program_version = "1.1";
  report.comparison.moves = {MoveOf("fixed", "position_error_cm", Movement::kSame, 1, 1),
                             MoveOf("fixed", "iterations", Movement::kBetter, 90, 60),
                             MoveOf("adaptive", "orientation_error_deg", Movement::kWorse, 2, 5),
                             MoveOf("adaptive", kOkShare, Movement::kUnclear, 0.5, 0.4)};
  report.expectations = {{"ik-weights", {"a below b", Ruling::kMet, "fine"}},
                         {"ik-weights", {"b below c", Ruling::kUnmet, "0.3 too much"}}};
  report.ratios = {{"ik-weights", {"adaptive", "fixed", 1.5, {}}, 60, 1.2, 1.1, 1.3, Ruling::kMet}};
  return report;
}

GateReport Nothing() {
  GateReport report;
  report.suite = "quick";
  return report;
}

TEST(GateMarkdown, ShowsAReviewerWhatFailsBeforeWhatElseMoved) {
  const std::string text = WriteGateMarkdown(Example());
  EXPECT_THAT(text, HasSubstr("## Etude gate of quick: regression\n"));
  EXPECT_THAT(text, HasSubstr("- against the baseline, 4 comparisons: 1 worse, 1 better, 1 unclear, 1 same\n"));
  EXPECT_THAT(text, HasSubstr("- 2 expectations: 1 unmet, 1 met\n"));
  EXPECT_THAT(text, HasSubstr("- ik-weights: b below c (0.3 too much)\n"));
  EXPECT_THAT(text,
              HasSubstr("| **worse** | ik-weights | joint\\_noise\\_deg=5 | adaptive | effector orientation error | "
                        "2.00° | 5.00° | 3.00° (2.50–3.50) | \\< 0.001 | 12 of 60 |\n"));
  EXPECT_LT(text.find("**worse**"), text.find("<details>"));
  EXPECT_GT(text.find("| better |"), text.find("<details>"));
  EXPECT_THAT(text, HasSubstr("50.0 % | 40.0 % | −10.00 percentage points"));
  EXPECT_THAT(text, Not(HasSubstr("effector position error")));  // it is the same
}

TEST(GateMarkdown, SaysThatNothingWasComparedWithoutABaseline) {
  EXPECT_THAT(WriteGateMarkdown(Nothing()),
              HasSubstr("quick: pass\n\n- nothing was compared: no baseline was given\n"));
}

TEST(GateMarkdown, SaysWhyThereIsNoVerdict) {
  GateReport report = Example();
  report.incomplete = {"s: 3 rows are missing"};
  const std::string text = WriteGateMarkdown(report);
  EXPECT_THAT(text, HasSubstr("## Etude gate of quick: incomplete\n"));
  EXPECT_THAT(text, HasSubstr("- s: 3 rows are missing\n"));
}

TEST(GateMarkdown, IsCutBeforeAPullRequestRefusesIt) {
  GateReport report = Example();
  report.comparison.moves.assign(5000, MoveOf("a", "iterations", Movement::kWorse, 1, 9));
  const std::string text = WriteGateMarkdown(report);
  EXPECT_LT(text.size(), 65536u);
  EXPECT_THAT(text, HasSubstr("and 4900 more rows"));
}

TEST(GateJunit, HasACaseForAllThatWasJudged) {
  const std::string xml = WriteGateJunit(Example());
  EXPECT_THAT(xml, HasSubstr("<testsuites name=\"quick gate\" tests=\"8\" failures=\"2\" errors=\"0\" skipped=\"1\">"));
  EXPECT_THAT(xml, HasSubstr("name=\"every cell can be judged\"/>"));
  EXPECT_THAT(xml, HasSubstr("name=\"joint_noise_deg=5, adaptive: effector orientation error\"><failure"));
  EXPECT_THAT(xml, HasSubstr("name=\"processor time of adaptive over fixed at most 1.5\"/>"));
}

TEST(GateJunit, FailsOneCaseOfAnIncompleteRunAndEscapesWhatItSays) {
  GateReport report = Nothing();
  report.incomplete = {"<a> & \"b\""};
  const std::string xml = WriteGateJunit(report);
  EXPECT_THAT(xml, HasSubstr("tests=\"1\" failures=\"1\""));
  EXPECT_THAT(xml, HasSubstr("&lt;a&gt; &amp; &quot;b&quot;"));
}

}  // namespace
}  // namespace etude
