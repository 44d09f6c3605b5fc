
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/gate_table.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

MetricMove MoveOf(const std::string& method, const std::string& metric, Movement movement, double before,
                  double after) {
  MetricMove move{.identity = {"ik-weights", "joint_noise_deg=5", method, metric}, .movement = movement, .worlds = 60};
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
  GateReport report{.suite = "quick", .baseline_file = "quick.json", .baseline_version = "1.0"};
  report.program_version = "1.1";
  report.comparison.moves = {MoveOf("fixed", "position_error_cm", Movement::kSame, 1, 1),
                             MoveOf("fixed", "iterations", Movement::kBetter, 90, 60),
                             MoveOf("adaptive", "orientation_error_deg", Movement::kWorse, 2, 5),
                             MoveOf("adaptive", kOkShare, Movement::kUndecided, 0.5, 0.4)};
  report.expectations = {{"ik-weights", {"a below b", ClaimOutcome::kMet, "fine"}},
                         {"ik-weights", {"b below c", ClaimOutcome::kUnmet, "0.3 too much"}}};
  report.ratios = {{"ik-weights", {"adaptive", "fixed", 1.5, {}}, 60, 1.2, 1.1, 1.3, ClaimOutcome::kMet}};
  return report;
}

GateReport Nothing() {
  GateReport report{.suite = "quick"};
  return report;
}

TEST(GateMarkdown, ShowsAReviewerWhatFailsBeforeWhatElseMoved) {
  const std::string text = WriteGateMarkdown(Example());
  EXPECT_THAT(text, HasSubstr("## Etude gate of quick: regression\n"));
  EXPECT_THAT(text, HasSubstr("- compared with the baseline: 4 comparisons: 1 worse, 1 better, 1 undecided, 1 same\n"));
  EXPECT_THAT(text, HasSubstr("- 2 expectations: 1 unmet, 1 met\n"));
  EXPECT_THAT(text, HasSubstr("- ik-weights: b below c (0.3 too much)\n"));
  EXPECT_THAT(text,
              HasSubstr("| **worse** | ik-weights | joint\\_noise\\_deg=5 | adaptive | effector orientation error | "
                        "2.00° | 5.00° | 3.00° (2.50–3.50) | \\< 0.001 | 12 of 60 |\n"));
  EXPECT_LT(text.find("**worse**"), text.find("<details>"));
  EXPECT_GT(text.find("| better |"), text.find("<details>"));
  EXPECT_THAT(text, HasSubstr("50.0 % | 40.0 % | −10.00 percentage points"));
  EXPECT_THAT(text, Not(HasSubstr("effector position error")));  // an unchanged metric is not mentioned
}

/// Returns the movement of a metric that is far worse in five of 60 worlds; in two of them, a value or an answer is
/// lost.
MetricMove TailMove(Movement movement) {
  MetricMove move = MoveOf("adaptive", "orientation_error_deg", movement, 2, 2);
  move.is_tail_judged = true;
  move.by_tail = movement == Movement::kWorse;
  move.tail = {{7, 0.05, std::nullopt, 'o', 'f', true}, {12, 2.0, std::nullopt, 'o', 'o', true}};
  for (int trial : {3, 1, 41}) move.tail.push_back({trial, 0.05, 60.05, 'o', 'u', false});
  return move;
}

TEST(GateMarkdown, NamesEveryFarWorseWorldWithBothValuesAndItsReplayCommand) {
  GateReport report = Example();
  report.run_folder = "out/my run";
  report.comparison.moves = {TailMove(Movement::kWorse)};
  const std::string text = WriteGateMarkdown(report);
  EXPECT_THAT(text, HasSubstr("| **worse in 5 worlds** |"));
  EXPECT_THAT(text, HasSubstr("12 of 60, 5 far worse |"));
  EXPECT_THAT(
      text,
      HasSubstr(
          "**Worlds in which a method became far worse:**\n\n- ik-weights, joint\\_noise\\_deg=5, trial 7, adaptive: "
          "effector orientation error 0.0500° → no value (failed): `etude replay 'out/my run' "
          "--cell ik-weights/joint_noise_deg=5/007/adaptive --baseline quick.json`\n"));
  EXPECT_THAT(text, HasSubstr("trial 3, adaptive: effector orientation error 0.0500° → 60.0°: `"));
  EXPECT_THAT(text, Not(HasSubstr("… and")));
}

TEST(GateMarkdown, CountsTheFarWorseWorldsThatItDoesNotName) {
  GateReport report = Example();
  MetricMove move = TailMove(Movement::kWorse);
  for (int trial = 100; trial < 125; ++trial) move.tail.push_back({trial, 0.05, 60.05, 'o', 'u', false});
  report.comparison.moves = {move};
  EXPECT_THAT(WriteGateMarkdown(report), HasSubstr("- … and 25 more worlds of ik-weights, joint\\_noise\\_deg=5"));
  report.comparison.moves.assign(200, move);
  for (int i = 0; i < 200; ++i) report.comparison.moves[i].identity.condition = std::to_string(i);
  const std::string text = WriteGateMarkdown(report);
  EXPECT_LT(text.size(), 65536u);
  EXPECT_THAT(text, HasSubstr("… and worlds of 193 more methods"));
}

TEST(GateTail, TellsAWorldOnceHoweverManyMetricsAreFarWorse) {
  GateReport report = Example();
  MetricMove ended = TailMove(Movement::kWorse), error = ended;
  ended.identity.metric = kOkShare;
  ended.tail = {{3, 1.0, 0.0, 'o', 'u', false}};
  report.comparison.moves = {ended, error};
  const auto lines = TailLines(report, TailGroup::kFailing, 5, 40);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_THAT(lines[0].world,
              HasSubstr("trial 3, adaptive: ok → unsolved; effector orientation error 0.0500° → 60.0°"));
}

TEST(GateMarkdown, ShowsFarWorseWorldsThatAreTooFewToFailAmongWhatElseMoved) {
  GateReport report = Example();
  report.comparison.moves = {TailMove(Movement::kUndecided)};
  const std::string text = WriteGateMarkdown(report);
  EXPECT_THAT(text, Not(HasSubstr("**Worlds in which a method became far worse:**")));
  EXPECT_LT(text.find("<details>"),
            text.find("Single worlds in which a method became far worse, but too few to fail the gate:"));
  EXPECT_LT(text.find("trial 7, adaptive"), text.find("</details>"));
  // With the tail rule off, no number of worlds would fail.
  report.comparison.moves.front().is_tail_judged = false;
  const std::string off = WriteGateMarkdown(report);
  EXPECT_THAT(off, Not(HasSubstr("too few to fail")));
  EXPECT_THAT(off, HasSubstr("not judged, because the scenario turned off the tail rule:"));
  EXPECT_LT(off.find("trial 7, adaptive"), off.find("</details>"));
}

TEST(GateJunit, NamesFarWorseWorldsInTheFailure) {
  GateReport report = Example();
  report.run_folder = "out/now";
  report.comparison.moves = {TailMove(Movement::kWorse)};
  EXPECT_THAT(WriteGateJunit(report),
              HasSubstr("trial 3, adaptive: effector orientation error 0.0500° → 60.0°: etude replay out/now --cell "
                        "ik-weights/joint_noise_deg=5/003/adaptive"));
}

TEST(GateTail, QuotesWhatAShellWouldTakeApartAndTellsStatuses) {
  MetricMove move = TailMove(Movement::kWorse);
  move.identity.condition = "poses={uniform: 0.5}";
  move.identity.metric = kOkShare;
  GateReport report{.run_folder = "it's"};
  const auto lines = TailLines({&move}, report, 1);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].replay, "etude replay 'it'\\''s' --cell 'ik-weights/poses={uniform: 0.5}/007/adaptive'");
  EXPECT_THAT(lines[0].world, HasSubstr("trial 7, adaptive: ok → failed"));
  EXPECT_THAT(lines[1].world, HasSubstr("… and 4 more worlds of"));
  report.run_folder = "";
  EXPECT_THAT(TailLines({&move}, report, 1)[0].replay, HasSubstr("etude replay RUN --cell "));
  report.runs_programs = true;
  EXPECT_THAT(TailLines({&move}, report, 1)[0].replay, HasSubstr("etude replay RUN --allow-exec --cell "));
}

TEST(GateMarkdown, FoldsAwayWhatIsUndecidedAndShowsTheAnswersOfTheRun) {
  GateReport report = Nothing();
  EXPECT_THAT(WriteGateMarkdown(report), Not(HasSubstr("<details>")));
  report.expectations = {{"ik", {"a below b", ClaimOutcome::kUndecided, "few"}}};
  report.answers = {{"ik", "noise=5", {.method = "a", .baseline = "b", .decided_by = AnswerStep::kSuccess}}};
  report.answers.front().answer.verdict = Verdict::kWorse;
  const std::string text = WriteGateMarkdown(report);
  EXPECT_THAT(text, HasSubstr("Undecided expectations and time rules (1)</summary>\n\nThese do not fail the gate:\n\n- "
                              "ik: a below b (few)\n"));
  EXPECT_THAT(text, HasSubstr("| ik | noise=5 | a | b | worse | success |\n"));
  EXPECT_THAT(
      text,
      HasSubstr("quick: pass, without a baseline\n\n- 1 expectation: 1 undecided\n- nothing was compared, because "
                "there is no baseline: the gate only judged the expectations"))
      << "answers decide nothing here";
}

TEST(GateMarkdown, SaysThatNothingWasComparedWithoutABaseline) {
  EXPECT_THAT(
      WriteGateMarkdown(Nothing()),
      HasSubstr(
          "quick: pass, without a baseline\n\n- nothing was compared, because there is no baseline: the scenarios "
          "have no expectations"));
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
  EXPECT_THAT(xml, HasSubstr("<property name=\"etude\" value=\"1.1\"/>"));
  EXPECT_THAT(xml,
              HasSubstr("<testsuites name=\"quick gate\" tests=\"10\" failures=\"2\" errors=\"0\" skipped=\"1\">"));
  EXPECT_THAT(xml, HasSubstr("name=\"every cell can be judged\"/>"));
  EXPECT_THAT(xml, HasSubstr("name=\"joint_noise_deg=5, adaptive: effector orientation error\"><failure"));
  EXPECT_THAT(xml, HasSubstr("name=\"processor time of adaptive divided by that of fixed: at most 1.5\"/>"));
}

TEST(GateJunit, FailsOneCaseOfAnIncompleteRunAndEscapesWhatItSays) {
  GateReport report = Nothing();
  report.incomplete = {"<a> & \"b\""};
  const std::string xml = WriteGateJunit(report);
  EXPECT_THAT(xml, HasSubstr("tests=\"3\" failures=\"1\""));
  EXPECT_THAT(xml, HasSubstr("&lt;a&gt; &amp; &quot;b&quot;"));
}

}  // namespace
}  // namespace etude
