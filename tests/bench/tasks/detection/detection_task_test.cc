#include <nlohmann/json.hpp>

#include "bench/tasks/base/task_kinds.h"
#include "tests/bench/tasks/detection/detection_fixture.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

class DetectionTask : public DetectionFixture {};

TEST_F(DetectionTask, FindsWhatAnExpertDoesWhenTheSensorHasNoErrors) {
  const auto task = *MakeTask(std::string("noise: 0\nevents: 8\npeople: expert\n") + kFourMethods, FourMoves());
  for (int trial = 0; trial < 3; ++trial) {
    const CellResult fixed = CellsOf(*task, trial).front();
    ASSERT_EQ(fixed.status, Status::kOk) << fixed.reason;
    EXPECT_GE(*ValueOf(fixed, "recall"), 0.75);
  }
}

TEST_F(DetectionTask, FailsToTellThemApartWhenTheSensorIsHopeless) {
  const auto task = *MakeTask(std::string("noise: 10\nevents: 8\n") + kFourMethods, FourMoves());
  double recall = 0;
  for (int trial = 0; trial < 3; ++trial) recall += *ValueOf(CellsOf(*task, trial).front(), "recall") / 3;
  EXPECT_LT(recall, 0.5);
}

TEST_F(DetectionTask, RepeatsItselfAndShowsEveryMethodTheSameWorld) {
  const auto task = *MakeTask(std::string("events: 4\n") + kFourMethods, FourMoves());
  const auto once = CellsOf(*task, 0), again = CellsOf(*task, 0), other = CellsOf(*task, 1);
  ASSERT_EQ(once.size(), 4u);
  for (std::size_t m = 0; m < once.size(); ++m) {
    EXPECT_EQ(once[m].digests, again[m].digests);
    EXPECT_EQ(DigestOf(once[m], "stream"), DigestOf(once[0], "stream"));
  }
  EXPECT_EQ(DigestOf(once[0], "filtered"), DigestOf(once[0], "stream"));
  EXPECT_NE(DigestOf(once[2], "filtered"), DigestOf(once[0], "stream"));
  EXPECT_NE(DigestOf(once[0], "session"), DigestOf(other[0], "session"));
}

TEST_F(DetectionTask, ChangesTheStreamButNotTheDanceWhenNoiseOrTurnIsSwept) {
  const auto run = [](const char* condition) {
    return CellsOf(**MakeTask(std::string(condition) + "events: 3\n" + kFourMethods, FourMoves()), 0).front();
  };
  const CellResult calm = run("noise: 0.5\n"), noisy = run("noise: 2\n"), turned = run("noise: 2\nturn_deg: 60\n");
  EXPECT_EQ(DigestOf(calm, "session"), DigestOf(noisy, "session"));
  EXPECT_EQ(DigestOf(calm, "session"), DigestOf(turned, "session"));
  EXPECT_NE(DigestOf(calm, "stream"), DigestOf(noisy, "stream"));
  EXPECT_NE(DigestOf(noisy, "stream"), DigestOf(turned, "stream"));
}

TEST_F(DetectionTask, SkipsClipsThatNobodyLabelledAndNamesThem) {
  ClipLibrary clips = FourMoves();
  clips.clips.insert(clips.clips.begin(), Unlabelled());
  const auto task = *MakeTask(std::string("events: 2\n") + kFourMethods, clips);
  EXPECT_EQ(task->ClipsOf(World(0)).front(), "walk");
  for (const CellResult& cell : CellsOf(*task, 0)) {
    EXPECT_EQ(cell.status, Status::kSkipped);
    EXPECT_EQ(cell.reason, "clip walk has no labelled moves: detection needs to know what was danced");
  }
  EXPECT_EQ(CellsOf(*task, 1).front().status, Status::kOk);
}

TEST_F(DetectionTask, RecordsWhatHappened) {
  const auto task = *MakeTask(std::string("events: 3\n") + kFourMethods, FourMoves());
  const CellResult cell = CellsOf(*task, 0, true).front();
  ASSERT_TRUE(cell.recording);
  ASSERT_EQ(cell.recording->tracks.size(), 2u);
  EXPECT_EQ(cell.recording->tracks[0].name, "truth");
  EXPECT_EQ(cell.recording->tracks[1].name, "sensed");
  const std::size_t frames = cell.recording->tracks[0].motion.poses.size();
  EXPECT_EQ(cell.recording->tracks[1].motion.poses.size(), frames);
  EXPECT_EQ(cell.series.back().values.size(), frames);

  const auto extras = nlohmann::json::parse(cell.recording->extras_json);
  EXPECT_EQ(extras["format"], "etude-detection");
  EXPECT_EQ(extras["joint_states"].size(), frames);
  EXPECT_EQ(extras["joint_states"][0].get<std::string>().size(), kRoleCount);
  ASSERT_EQ(extras["events"].size(), 3u);
  EXPECT_EQ(extras["events"][0].contains("called_frame"), extras["events"][0]["called_right"].get<bool>());
}

TEST_F(DetectionTask, ShowsAnOracleTheTruthWhateverTheSensorDoes) {
  const char* yaml = "noise: 10\nturn_deg: 60\nevents: 8\nmethods: [{name: seen}, {name: oracle, oracle: [stream]}]\n";
  const auto task = *MakeTask(yaml, FourMoves());
  for (int trial = 0; trial < 2; ++trial) {
    const auto cells = RunWorld(*task, World(trial), 2);
    EXPECT_GT(ValueOf(cells[1], "f1").value_or(0), ValueOf(cells[0], "f1").value_or(0));
    EXPECT_EQ(DigestOf(cells[0], "stream"), DigestOf(cells[1], "stream")) << "the same world";
    EXPECT_NE(DigestOf(cells[1], "filtered"), DigestOf(cells[1], "stream"));
  }
}

TEST_F(DetectionTask, CreditsAMethodWithoutAnswerWithTheMissesItMade) {
  const auto task = *MakeTask(std::string("events: 2\n") + kFourMethods, FourMoves());
  for (const std::string& metric : MakeDetectionTaskKind().metrics) {
    const bool counts_misses = metric == "f1" || metric == "recall";
    EXPECT_EQ(task->ValueOfFailure(metric), counts_misses ? std::optional(0.0) : std::nullopt) << metric;
  }
  const auto all_wrong = *MakeTask(std::string("fault_share: 1\n") + kFourMethods, FourMoves());
  EXPECT_EQ(all_wrong->ValueOfFailure("recall"), std::nullopt) << "nothing could be missed";
}

}  // namespace
}  // namespace etude
