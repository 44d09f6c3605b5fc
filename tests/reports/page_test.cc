#include "reports/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "io/drawing/escape.h"
#include "reports/words/findings.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::string_view kIsland = "<script type=\"application/json\"";

/// Returns the page without its scripts, as a browser reads the markup.
std::string MarkupOf(const std::string& page) {
  std::string markup;
  std::size_t from = 0;
  for (std::size_t at = page.find("<script"); at != std::string::npos; at = page.find("<script", from)) {
    markup += page.substr(from, at - from);
    from = page.find("</script>", at);
  }
  return markup + page.substr(from);
}

/// Returns every reference that would make a browser load something else.
std::vector<std::string> OutsideReferences(const std::string& page) {
  const std::string markup = MarkupOf(page);
  const std::regex reference(
      R"re((src|href|poster|data|action)="([^"]{0,40})|url\(([^)]{0,40})|@import|<link|<iframe)re");
  std::vector<std::string> found;
  for (auto it = std::sregex_iterator(markup.begin(), markup.end(), reference); it != std::sregex_iterator(); ++it) {
    const std::string target = (*it)[2];
    const bool is_link =
        (*it)[1] == "href" && std::regex_match(target, std::regex("(\\.\\./)?[A-Za-z0-9_%~-][A-Za-z0-9_./%~-]*"));
    if (!target.starts_with("data:") && !target.starts_with("#") && !is_link) found.push_back(it->str());
  }
  return found;
}

std::vector<std::string> IslandsOf(const std::string& page) {
  std::vector<std::string> islands;
  for (std::size_t at = page.find(kIsland); at != std::string::npos; at = page.find(kIsland, at + 1)) {
    const std::size_t begin = page.find('>', at) + 1;
    islands.push_back(page.substr(begin, page.find("</script>", begin) - begin));
  }
  return islands;
}

TEST(Page, ShowsRealTakesBesideSimulatedOnes) {
  EXPECT_THAT(WritePage(ExampleRun(), {}), Not(HasSubstr("Captures of real films")));
  const std::vector<RealTake> real = {
      {.name = "beam <1>",
       .recovery = "silhouettes",
       .reference = "r.trc",
       .films = {"a.mp4", "b.mp4", "c.mp4"},
       .frames = 100,
       .rate_hz = 60,
       .distances = {{"all", 60.25, 143.0}, {"1+2", std::nullopt, std::nullopt}}},
      {.name = "other", .recovery = "keypoints", .reference = "r.trc", .frames = 1, .distances = {{"all", 9.0, 10.0}}}};
  RunData run = ExampleRun();
  run.scenarios.front().task = "capture";
  ConditionSummary& condition = run.scenarios.front().conditions.front();
  condition.methods.front().metrics.front().id = "mpjpe_mm";
  condition.methods.front().metrics.front().median = 19.5;
  const std::string page = WritePage(run, {}, real);
  const std::size_t section = page.find("Captures of real films");
  ASSERT_NE(section, std::string::npos);
  const std::string shown = page.substr(section, page.find("</section>", section) - section);
  EXPECT_THAT(shown, HasSubstr("<td>real: beam &lt;1&gt;, 100 frames</td><td>silhouettes (error)</td><td>all 3</td>"
                               "<td class=\"n\">60.2</td><td class=\"n\">143</td>"));
  EXPECT_THAT(shown, HasSubstr("<td>1+2</td><td class=\"n\">—</td><td class=\"n\">—</td>"));
  EXPECT_THAT(shown, HasSubstr("keypoints (agreement)"));
  EXPECT_THAT(shown, HasSubstr("<td class=\"n\">19.5</td>"));
}

TEST(Page, TellsEveryScenarioItsAnswerAndEveryFailuresReason) {
  RunData run = ExampleRun();
  std::ranges::find(run.rows, Status::kOk, [](const Row& row) { return row.result.status; })->result.reason +=
      DoubtfulPart("the answer: ", {"freezes <2 s>"});
  const std::string page = WritePage(run, {});
  EXPECT_THAT(page, HasSubstr(EscapeMarkup(FindingsOf(run).sentence)));
  int checked = 0;
  for (const ScenarioSummary& scenario : run.scenarios) {
    EXPECT_THAT(page, HasSubstr(EscapeMarkup(scenario.question)));
    const ScenarioFindings findings = FindingsOf(run, scenario);
    EXPECT_THAT(page, HasSubstr(EscapeMarkup(findings.answer.sentence)));
    for (const ReasonCount& doubt : findings.doubts) {
      EXPECT_THAT(page, HasSubstr("<li>" + EscapeMarkup(DescribeCount(doubt)) + "</li>"));
      EXPECT_THAT(page, HasSubstr(", 1 doubtful"));
      ++checked;
    }
    for (const ReasonCount& reason : findings.reasons) {
      EXPECT_THAT(page, HasSubstr(EscapeMarkup(reason.reason)));
      ++checked;
    }
    for (const ExpectationResult& expectation : scenario.expectations) {
      EXPECT_THAT(page, HasSubstr(EscapeMarkup(expectation.text)));
    }
  }
  EXPECT_GE(checked, 4);
}

TEST(Page, AnswersBeforeAnythingElseAndFoldsTheRest) {
  RunData run = ExampleRun();
  run.scenarios[0].description = "Clips change";
  run.scenarios[0].descriptions = {"cuts at once", "", "paper A’s <way>", "", ""};
  const std::string page = WritePage(run, {});
  const std::size_t card = page.find("<article"), fold = page.find("<details", card);
  ASSERT_LT(card, fold);
  const std::string shown = page.substr(card, fold - card);
  EXPECT_THAT(shown, HasSubstr(EscapeMarkup(FindingsOf(run, run.scenarios[0]).answer.sentence)));
  EXPECT_THAT(shown, HasSubstr("<table class=\"figures\">"));
  EXPECT_THAT(shown, HasSubstr("<svg"));
  EXPECT_LT(page.find("<ol class=\"answers\">"), card);
  EXPECT_THAT(page.substr(0, card), HasSubstr(EscapeMarkup(FindingsOf(run, run.scenarios[0]).headline)));
  EXPECT_THAT(page.substr(fold), HasSubstr("<p>Clips change</p>"));
  EXPECT_THAT(page.substr(fold), HasSubstr("paper A’s &lt;way&gt;</dd>"));
  EXPECT_THAT(page, Not(HasSubstr("<details open")));
}

TEST(Page, LinksTheFilesOfEveryScenario) {
  const std::string page = WritePage(ExampleRun(), {});
  for (const char* file : {"tables/capture.csv", "tables/capture-comparisons.csv", "tables/capture.tex",
                           "../manifest.json", "../summary.json", "summary.md", "junit.xml"}) {
    EXPECT_THAT(page, HasSubstr(std::string("<a href=\"") + file + "\">")) << file;
  }
}

TEST(Page, PointsToNothingOutsideItself) {
  Media media;
  media.film.mp4 = "film";
  media.film.poster = {"png", 1280, 720, "poster"};
  EXPECT_THAT(OutsideReferences(WritePage(ExampleRun(), media)), ::testing::IsEmpty());
  // The control: the search finds such references.
  EXPECT_THAT(OutsideReferences("<img src=\"https://example.org/a.png\">"), ::testing::SizeIs(1));
  EXPECT_THAT(OutsideReferences("<link rel=stylesheet>"), ::testing::SizeIs(1));
  for (const char* target :
       {"https://example.org", "//example.org", "javascript:alert(1)", "../../etc/passwd", "/etc/passwd"}) {
    EXPECT_THAT(OutsideReferences(std::string("<a href=\"") + target + "\">"), ::testing::SizeIs(1)) << target;
  }
  EXPECT_THAT(OutsideReferences("<a href=\"tables/a.csv\"><a href=\"../summary.json\">"), ::testing::IsEmpty());
}

TEST(Page, SurvivesHostileNames) {
  RunData run = ExampleRun();
  const std::string hostile = "</script><script>alert(1)</script>&\"'\xff";
  run.suite = run.host = run.command_line = hostile;
  ScenarioSummary& scenario = run.scenarios.back();
  for (Row& row : run.rows) {
    if (row.scenario == scenario.name) row.scenario = hostile;
    if (row.method == "ccd-fixed") row.method = hostile;
    if (row.result.status != Status::kOk) row.result.reason = hostile;
  }
  scenario.name = scenario.question = scenario.methods[1] = hostile;
  scenario.conditions[0].methods[1].method = hostile;
  scenario.conditions[0].comparisons[0].method = hostile;
  scenario.expectations = {{hostile, ClaimOutcome::kUnmet, hostile}};
  scenario.description = hostile;
  scenario.descriptions.assign(scenario.methods.size(), hostile);
  run.recordings.push_back({hostile + "/-/000/" + hostile, {}});

  const std::string page = WritePage(run, {});
  EXPECT_THAT(OutsideReferences(page), ::testing::IsEmpty());
  const std::string summary = WriteMarkdown(run);
  EXPECT_THAT(summary, Not(HasSubstr("<script>")));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  for (const std::string& island : IslandsOf(page)) {
    EXPECT_TRUE(nlohmann::json::accept(island)) << island;
  }
}

TEST(Page, ShowsAMissingValueAsADashWithItsReason) {
  RunData run = ExampleRun();
  MetricSummary& metric = run.scenarios.front().conditions[0].methods[0].metrics[0];
  metric = {metric.id, 0, 12, std::nullopt, std::nullopt, std::nullopt, std::nullopt};
  for (Row& row : run.rows) {
    if (row.scenario != "transition" || row.method != "now") continue;
    row.result.metrics.clear();
    row.result.Missing(metric.id, "the seam lies in the clip's last frame");
  }
  const std::string page = WritePage(run, {});
  EXPECT_THAT(page, HasSubstr("data-v=\"\">— <small>0 of 12</small></td>"));
  EXPECT_THAT(page, HasSubstr("<li>now, 12 of 12: 12 × the seam lies in the clip&#39;s last frame"));
}

TEST(Page, SaysWhyThereIsNoFilm) {
  Media media;
  media.film.why_not = "There is no film: ffmpeg could not be started.";
  EXPECT_THAT(WritePage(ExampleRun(), media), HasSubstr(media.film.why_not));
}

TEST(Page, ExplainsRecordedSwitches) {
  RunData run = ExampleRun();
  EXPECT_THAT(WritePage(run, {}), Not(HasSubstr("Partial distances")));
  AddTransitions(run);
  const std::string page = WritePage(run, {});
  EXPECT_THAT(page, HasSubstr("Why each method chose its frames: clap → side kick, trial 7"));
  EXPECT_THAT(page, HasSubstr(".partials"));
}

TEST(Page, OfHundredsOfMethodsCutsItsListsAndSaysSo) {
  RunData run = ExampleRun();
  ScenarioSummary& scenario = run.scenarios.front();
  ConditionSummary& condition = scenario.conditions[0];
  const MethodSummary method = condition.methods[1];
  const Comparison comparison = condition.comparisons[0];
  for (int i = 0; i < 500; ++i) {
    const std::string name = "method-" + std::to_string(i);
    scenario.methods.push_back(name);
    condition.methods.push_back(method);
    condition.comparisons.push_back(comparison);
    condition.methods.back().method = condition.comparisons.back().method = name;
  }
  const std::string page = WritePage(run, {});
  EXPECT_THAT(page, HasSubstr("465 more methods are not shown here"));
  EXPECT_THAT(page, HasSubstr("more rows are not shown here; all of them are in the CSV file in report/tables."));
  EXPECT_THAT(page, HasSubstr("more comparisons are not shown here"));
}

TEST(Page, OfAnEmptyRunIsStillAPage) {
  const std::string page = WritePage(RunData{}, {});
  EXPECT_THAT(page, HasSubstr("No cell ran."));
  EXPECT_THAT(page, HasSubstr("</html>"));
}

}  // namespace
}  // namespace etude
