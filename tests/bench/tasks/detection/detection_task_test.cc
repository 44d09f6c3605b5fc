#include "bench/tasks/detection/detection_task.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace etude {
namespace {

constexpr const char* kFourMethods = R"(
methods:
  - {name: fixed, weights: fixed, threshold: 1}
  - {name: adaptive, weights: adaptive}
  - {name: fixed-holt, filter: holt, threshold: 1}
  - {name: adaptive-euro, filter: one-euro, weights: adaptive}
)";

/// A task made of a scenario's text; the text must live as long as the task is being made only.
Result<std::unique_ptr<Task>> MakeTask(const std::string& yaml, const ClipLibrary& clips, bool recordings = false) {
  auto node = ParseYaml(yaml, "test.yaml");
  if (!node) return tl::unexpected(node.error());
  Fields condition(*node, "a detection scenario");
  TaskInput input{condition, node->Find("methods")->items, clips, recordings};
  return MakeDetectionTaskKind().make(input);
}

ClipLibrary FourMoves() {
  return *LoadClips({"builtin:clap", "builtin:boxing", "builtin:sway", "builtin:side_kick"}, {});
}

/// A clip as a user's file gives it: no move is known.
LibraryClip Unlabelled() {
  LibraryClip clip;
  clip.name = "walk";
  clip.motion = FourMoves().clips.front().motion;
  return clip;
}

WorldKey World(int trial) { return {.suite_seed = 1, .scenario = "detection-test", .trial = trial}; }

std::optional<double> Metric(const CellResult& cell, std::string_view id) {
  for (const MetricValue& metric : cell.metrics) {
    if (metric.id == id) return metric.value;
  }
  ADD_FAILURE() << "no metric " << id;
  return std::nullopt;
}

std::string DigestOf(const CellResult& cell, std::string_view stage) {
  for (const auto& [name, digest] : cell.digests) {
    if (name == stage) return digest;
  }
  ADD_FAILURE() << "no digest of " << stage;
  return "";
}

TEST(DetectionTask, TellsRightFromWrongWithoutErrorWhenTheSensorHasNone) {
  const auto task = *MakeTask(std::string("noise: 0\nevents: 8\n") + kFourMethods, FourMoves());
  for (int trial = 0; trial < 3; ++trial) {
    const CellResult fixed = task->RunWorld(World(trial)).front();
    ASSERT_EQ(fixed.status, Status::kOk) << fixed.reason;
    EXPECT_EQ(Metric(fixed, "f1"), 1.0);
    EXPECT_EQ(Metric(fixed, "roc_auc"), 1.0);
    // It answers once the last pose was held for three frames, two frames after it was truly reached.
    EXPECT_NEAR(*Metric(fixed, "latency_s"), 2.0 / 30, 0.5 / 30);
  }
}

TEST(DetectionTask, FailsToTellThemApartWhenTheSensorIsHopeless) {
  const auto task = *MakeTask(std::string("noise: 10\nevents: 8\n") + kFourMethods, FourMoves());
  double recall = 0;
  for (int trial = 0; trial < 3; ++trial) recall += *Metric(task->RunWorld(World(trial)).front(), "recall") / 3;
  EXPECT_LT(recall, 0.5);
}

TEST(DetectionTask, RepeatsItselfAndShowsEveryMethodTheSameWorld) {
  const auto task = *MakeTask(std::string("events: 4\n") + kFourMethods, FourMoves());
  const auto once = task->RunWorld(World(0)), again = task->RunWorld(World(0)), other = task->RunWorld(World(1));
  ASSERT_EQ(once.size(), 4u);
  for (std::size_t m = 0; m < once.size(); ++m) {
    EXPECT_EQ(once[m].digests, again[m].digests);
    EXPECT_EQ(DigestOf(once[m], "stream"), DigestOf(once[0], "stream"));
  }
  EXPECT_EQ(DigestOf(once[0], "filtered"), DigestOf(once[0], "stream"));
  EXPECT_NE(DigestOf(once[2], "filtered"), DigestOf(once[0], "stream"));
  EXPECT_NE(DigestOf(once[0], "session"), DigestOf(other[0], "session"));
}

TEST(DetectionTask, ChangesTheStreamButNotTheDanceWhenNoiseOrTurnIsSwept) {
  const auto run = [](const char* condition) {
    return (*MakeTask(std::string(condition) + "events: 3\n" + kFourMethods, FourMoves()))->RunWorld(World(0)).front();
  };
  const CellResult calm = run("noise: 0.5\n"), noisy = run("noise: 2\n"), turned = run("noise: 2\nturn_deg: 60\n");
  EXPECT_EQ(DigestOf(calm, "session"), DigestOf(noisy, "session"));
  EXPECT_EQ(DigestOf(calm, "session"), DigestOf(turned, "session"));
  EXPECT_NE(DigestOf(calm, "stream"), DigestOf(noisy, "stream"));
  EXPECT_NE(DigestOf(noisy, "stream"), DigestOf(turned, "stream"));
}

TEST(DetectionTask, SkipsClipsThatNobodyLabelledAndNamesThem) {
  ClipLibrary clips = FourMoves();
  clips.clips.insert(clips.clips.begin(), Unlabelled());
  const auto task = *MakeTask(std::string("events: 2\n") + kFourMethods, clips);
  EXPECT_EQ(task->ClipOf(World(0)), "walk");
  for (const CellResult& cell : task->RunWorld(World(0))) {
    EXPECT_EQ(cell.status, Status::kSkipped);
    EXPECT_EQ(cell.reason, "clip walk has no labelled moves: detection needs to know what was danced");
    EXPECT_EQ(cell.metrics.size(), 6u);
    for (const MetricValue& metric : cell.metrics) EXPECT_FALSE(metric.value);
  }
  EXPECT_EQ(task->RunWorld(World(1)).front().status, Status::kOk);
}

TEST(DetectionTask, RecordsWhatHappened) {
  const auto task = *MakeTask(std::string("events: 3\n") + kFourMethods, FourMoves(), true);
  const CellResult cell = task->RunWorld(World(0)).front();
  ASSERT_TRUE(cell.recording);
  ASSERT_EQ(cell.recording->tracks.size(), 2u);
  EXPECT_EQ(cell.recording->tracks[0].name, "truth");
  EXPECT_EQ(cell.recording->tracks[1].name, "sensed");
  const std::size_t frames = cell.recording->tracks[0].motion.poses.size();
  EXPECT_EQ(cell.recording->tracks[1].motion.poses.size(), frames);
  EXPECT_EQ(cell.series.front().values.size(), frames);

  const auto extras = nlohmann::json::parse(cell.recording->extras_json);
  EXPECT_EQ(extras["format"], "etude-detection");
  EXPECT_EQ(extras["joint_states"].size(), frames);
  EXPECT_EQ(extras["joint_states"][0].get<std::string>().size(), kRoleCount);
  ASSERT_EQ(extras["events"].size(), 3u);
  EXPECT_EQ(extras["events"][0].contains("called_frame"), extras["events"][0]["called_right"].get<bool>());
}

struct BadScenario {
  const char* yaml;
  const char* complaint;
};

TEST(DetectionTask, RefusesWhatItDoesNotKnowAndSaysWhatIsAllowed) {
  const std::vector<BadScenario> cases = {
      {"methods:\n  - {name: a, filter: hold}\n", "'holt'"},
      {"methods:\n  - {name: a, recogniser: dtw}\n", "key-pose"},
      {"methods:\n  - {name: a, weights: adaptiv}\n", "'adaptive'"},
      {"methods:\n  - {name: a, treshold: 0.5}\n", "threshold"},
      {"methods:\n  - {name: a, weights: fixed, inferred_weight: 0.5}\n", "inferred_weight"},
      {"noise: -1\nmethods:\n  - {name: a}\n", "-1"},
      {"turn_deg: east\nmethods:\n  - {name: a}\n", "east"},
  };
  for (const BadScenario& bad : cases) {
    const auto task = MakeTask(bad.yaml, FourMoves());
    ASSERT_FALSE(task) << bad.yaml;
    EXPECT_NE(task.error().message.find(bad.complaint), std::string::npos) << task.error().message;
    EXPECT_GT(task.error().place.line, 0) << bad.yaml;
  }
  EXPECT_FALSE(MakeTask("methods:\n  - {name: a}\n", ClipLibrary{}));
  EXPECT_TRUE(MakeTask("methods:\n  - {name: a}\n", FourMoves()));  // control
}

}  // namespace
}  // namespace etude
