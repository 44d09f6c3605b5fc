#include "reports/plots/pairs.h"

#include <gmock/gmock.h>

#include <vector>

#include "bench/model/recording.h"
#include "bench/recordings/evaluation_extras.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two pairs of files and a method; the second pair's error peaks at frame 7 of 20.
RunData MakeRun() {
  RunData run;
  ScenarioSummary& scenario = run.scenarios.emplace_back();
  scenario.name = "s";
  scenario.task = "evaluation";
  scenario.methods = {"mine <b>"};
  scenario.conditions.emplace_back();
  for (int trial = 0; trial < 2; ++trial) {
    Row row;
    row.scenario = "s";
    row.task = "evaluation";
    row.trial = trial;
    row.clip = trial == 0 ? "calm" : "wild <i>";
    row.method = "mine <b>";
    std::vector<double> errors(20, 10.0);
    if (trial == 1) errors[7] = 123;
    run.series.push_back({row.Id(), {{"mpjpe_unaligned_mm", "frame", errors}}});
    run.rows.push_back(std::move(row));
  }
  return run;
}

TEST(PairsHtml, BeginsWithTheWorstPairAndEscapesNames) {
  const RunData run = MakeRun();
  const std::string html = PairsHtml(run, run.scenarios[0]);
  const std::size_t wild = html.find("wild &lt;i&gt;: largest error 123 mm"),
                    calm = html.find("calm: largest error 10");
  ASSERT_NE(wild, std::string::npos) << html;
  ASSERT_NE(calm, std::string::npos) << html;
  EXPECT_LT(wild, calm);
  EXPECT_THAT(html, Not(HasSubstr("<i>")));
  EXPECT_THAT(html, Not(HasSubstr("data-frame"))) << "nothing is recorded";
}

TEST(PairsHtml, ShowsTheWorstFramesOfWhatIsRecorded) {
  RunData run = MakeRun();
  EvaluationExtras extras;
  extras.truth.rate_hz = 30;
  extras.truth.joints = {"root", "tail"};
  extras.truth.parents = {-1, 0};
  for (int f = 0; f < 20; ++f) {
    extras.truth.positions.insert(extras.truth.positions.end(), {{0, 0, 0}, {0, 1, 0}});
  }
  extras.answer = extras.truth;
  extras.answer.positions[2 * 7 + 1] = NotSeen();
  run.recordings.push_back({run.rows[1].Id(), Recording({}, WriteEvaluationExtras(extras))});
  const std::string html = PairsHtml(run, run.scenarios[0]);
  EXPECT_THAT(html, HasSubstr("data-frame=\"7\">mine &lt;b&gt;: 123 mm after 0.23 s</button>"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  // An unreadable recording is reported, and the curves stay.
  run.recordings[0].recording.extras_json = "{}";
  const std::string told = PairsHtml(run, run.scenarios[0]);
  EXPECT_THAT(told, HasSubstr("this recording of an evaluation cannot be read"));
  EXPECT_THAT(told, HasSubstr("polyline"));
}

TEST(PairsHtml, NamesTheErrorOfItsTitleAndTheFramesOfAPoint) {
  RunData run = MakeRun();
  std::vector<double> longer(200, 10.0);
  run.series[0].series = {{"mpjpe_unaligned_mm", "frame", longer}, {"mpjpe_root_mm", "frame", std::vector(200, 400.0)}};
  const std::string html = PairsHtml(run, run.scenarios[0]);
  EXPECT_THAT(html, HasSubstr("calm: largest error 10.0 mm (joint error, unaligned)"));
  EXPECT_THAT(html, HasSubstr("joint error, unaligned, mm, maximum of every 3 frames"));
  EXPECT_THAT(html, HasSubstr("joint error, unaligned, mm, by frame")) << "of the pair with 20 frames";
  EXPECT_LT(html.find("wild"), html.find("calm")) << "pairs are ordered by the error of the title";
}

TEST(PairsHtml, IsEmptyForOtherTasks) {
  RunData run = MakeRun();
  run.scenarios[0].task = "ik";
  EXPECT_EQ(PairsHtml(run, run.scenarios[0]), "");
}

}  // namespace
}  // namespace etude
