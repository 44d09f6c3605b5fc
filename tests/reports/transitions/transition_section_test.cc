#include "reports/transitions/transition_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/support/count_of.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Example {
  Example() : run(ExampleRun()) { AddTransitions(run); }
  std::vector<RecordedRequest> Worlds() const { return RecordedRequestsOf(run, run.scenarios.front()); }
  RunData run;
};

TEST(TransitionSection, TellsTheWayTheDistancesAndWhyTheWinnerWon) {
  const std::string html = TransitionsHtml(Example().Worlds());
  EXPECT_THAT(html, HasSubstr("It asks nothing &amp; &lt;changes&gt; at once."));
  EXPECT_THAT(html, HasSubstr("clap 30 → in-between 0 … in-between 14 → side kick 2"));
  EXPECT_THAT(html, HasSubstr("3 of 120"));
  EXPECT_THAT(html, HasSubstr("0.500 ≥ 0.4"));
  EXPECT_THAT(html, HasSubstr("0.350 &lt; 0.4"));
  // Two methods have one point, the third has two: 4 × 10 partial distances, of which three each are not 0.
  EXPECT_EQ(CountOf(html, "<i class="), 40);
  EXPECT_EQ(CountOf(html, "width:0%"), 28);
}

TEST(TransitionSection, MarksTheOneCandidateThatWasTaken) {
  const std::string html = TransitionsHtml(Example().Worlds());
  EXPECT_EQ(CountOf(html, "class=\"taken\""), 1);
  EXPECT_THAT(
      html, HasSubstr("<tr class=\"taken\"><td>✓ taken</td><td class=\"n\">clap 28</td><td class=\"n\">side kick 4</td>"
                      "<td class=\"n\">0.200</td><td class=\"n\">9.25</td>"
                      "<td>RH 0.016, LH 0.016, RF 0.008</td></tr>"));
  EXPECT_THAT(html, HasSubstr("Cost (cm)"));
  EXPECT_THAT(html, HasSubstr("3 of 120 pairs of frames"));
}

TEST(TransitionSection, TellsForWhichOfTwoMeetingsACandidateWasLookedAt) {
  Example example;
  std::string& extras = example.run.recordings[1].recording.extras_json;
  extras.back() = ',';
  extras += R"("candidates": [{"point": 0, "from_frame": 30, "to_frame": 0, "distance": 0.3},
      {"point": 1, "from_frame": 14, "to_frame": 2, "distance": 0.35},
      {"point": 7, "from_frame": 8, "to_frame": 9, "distance": 0.1}]})";
  // Older recordings lack this.
  extras.insert(extras.rfind(']'), R"(, {"from_frame": 5, "to_frame": 6, "distance": 0.1})");
  const std::string html = TransitionsHtml(example.Worlds());
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">5</td><td class=\"n\">6</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">clap 30</td><td class=\"n\">in-between 0</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">in-between 14</td><td class=\"n\">side kick 2</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">8</td><td class=\"n\">9</td>"));
}

TEST(TransitionSection, ShowsEqualCandidatesOnce) {
  Example example;
  example.run.recordings[0].recording.extras_json = example.run.recordings[2].recording.extras_json;
  const std::string html = TransitionsHtml(example.Worlds());
  EXPECT_THAT(html, HasSubstr("Candidates that now, gate-inertialised considered"));
  EXPECT_EQ(CountOf(html, "class=\"taken\""), 1);
}

TEST(TransitionSection, KeepsUsersNamesFromSpeakingMarkup) {
  Example example;
  for (CellRecording& recorded : example.run.recordings) {
    recorded.recording.extras_json =
        R"({"transition_frame": 3, "from": "<script>", "to": "|a|", "branch": "<b>", "why": "<i>", "cost_unit": "<u>",
            "candidates": [{"from_frame": 1, "to_frame": 2, "distance": 0.1, "cost": 1, "outcome": "<s>"}]})";
  }
  const std::string html = TransitionsHtml(example.Worlds());
  for (const char* tag : {"<script>", "<b>", "<i>", "<u>", "<s>"}) EXPECT_THAT(html, Not(HasSubstr(tag)));
  EXPECT_THAT(TransitionsMarkdown(example.Worlds()), Not(HasSubstr("|a|")));
}

TEST(TransitionSection, IsEmptyWithoutRecordingsAndShortWithMany) {
  EXPECT_EQ(TransitionsHtml({}), "");
  EXPECT_EQ(TransitionsMarkdown({}), "");
  const Example example;
  const std::vector<RecordedRequest> many(50, example.Worlds().front());
  EXPECT_EQ(CountOf(TransitionsHtml(many), "<summary>"), 6);
  EXPECT_THAT(TransitionsHtml(many), HasSubstr("44 more requests are not shown here"));
  EXPECT_THAT(TransitionsMarkdown(many), HasSubstr("44 more requests are not shown here"));
}

TEST(DistanceTable, GivesAFullBarToWhatAloneReachesTheThreshold) {
  PerFeature partials{};
  partials[0] = 0.04;
  partials[1] = 0.2;
  PointFacts point;
  point.partials = partials;
  DistanceTable table;
  table.AddPoint("m", point, 0.4);
  EXPECT_THAT(table.Html(), HasSubstr("0.040<i class=\"\" style=\"width:25%\">"));
  EXPECT_THAT(table.Html(), HasSubstr("0.200<i class=\"over\" style=\"width:100%\">"));
  EXPECT_THAT(table.Html(), HasSubstr("0.490 ≥ 0.4"));  // √0.24, computed because the recording has no d
}

TEST(DistanceTable, TellsWeightsOnceForAllWhoShareThem) {
  PointFacts point;
  point.partials = PerFeature{};
  DistanceTable table;
  table.AddPoint("a", point, std::nullopt);
  FeatureWeights learnt = PaperWeights();
  std::swap(learnt[0], learnt[9]);
  table.AddWeights("a", PaperWeights());
  table.AddWeights("b", PaperWeights());
  EXPECT_THAT(table.Html(), HasSubstr("<td>weight S</td>"));
  table.AddWeights("c", learnt);
  EXPECT_THAT(table.Html(), HasSubstr("<td>weight S of a, b</td>"));
  EXPECT_THAT(table.Html(), HasSubstr("<td>weight S of c</td>"));
}

TEST(MostlyBy, NamesTheLargestPartsInOrder) {
  PerFeature partials{};
  EXPECT_EQ(MostlyBy(partials), "all alike");
  partials[2] = 0.01;
  partials[9] = 0.2;
  EXPECT_EQ(MostlyBy(partials), "LFK 0.200, RHE 0.010");
}

}  // namespace
}  // namespace etude
