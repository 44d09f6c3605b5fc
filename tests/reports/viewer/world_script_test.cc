#include "reports/viewer/world_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/recordings/evaluation_extras.h"
#include "bench/recordings/task_extras.h"
#include "io/drawing/assets/assets.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Returns a person who walks along a curve for ten seconds; every joint moves.
BodyMotion Walk(int frames = 300) {
  BodyMotion motion;
  for (int f = 0; f < frames; ++f) {
    BodyPose pose;
    for (const Role role : AllRoles()) {
      const double j = static_cast<double>(Index(role)), t = f / kJudgedRateHz;
      pose[role] = {2 * std::sin(0.6 * t) + 0.1 * std::sin(3 * t + j), 0.09 * j + 0.05 * std::cos(5 * t + j), -0.3 * t};
    }
    motion.poses.push_back(pose);
  }
  return motion;
}

std::vector<glm::dvec3> PointsOf(const BodyMotion& motion) {
  std::vector<glm::dvec3> points;
  for (const BodyPose& pose : motion.poses) points.insert(points.end(), pose.joints.begin(), pose.joints.end());
  return points;
}

nlohmann::json JsonOf(const std::string& script) {
  constexpr std::string_view kCall = "etudeMotion(";
  EXPECT_TRUE(script.starts_with(kCall) && script.ends_with(");\n"));
  return nlohmann::json::parse(script.substr(kCall.size(), script.size() - kCall.size() - 3), nullptr, false);
}

/// Decodes a position from Base64 by hand, as the page's script does.
double DecodedAt(const nlohmann::json& body, std::size_t frame, std::size_t joint, std::size_t axis) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::string& text = body.at("data").get_ref<const std::string&>();
  const auto byte = [&](std::size_t i) {
    const std::size_t first = i / 3 * 4;
    unsigned bits = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t letter = kLetters.find(text.at(first + k));
      bits = bits << 6 | static_cast<unsigned>(letter == std::string_view::npos ? 0 : letter);
    }
    return bits >> (16 - 8 * (i % 3)) & 255;
  };
  const std::size_t at = 2 * (60 * frame + 3 * joint + axis);
  return body.at("low_m").at(axis).get<double>() + body.at("step_m").get<double>() * (byte(at) + 256.0 * byte(at + 1));
}

TEST(WorldScript, QuantisesWithinHalfAStepAndTenSecondsInThirtySixKilobytes) {
  std::vector<glm::dvec3> points = PointsOf(Walk());
  const QuantisedMotion quantised = Quantise(points);
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 off = glm::abs(quantised.At(i) - points[i]);
    worst = std::max({worst, off.x, off.y, off.z});
  }
  EXPECT_LE(worst, quantised.step / 2 + 1e-12);
  EXPECT_GT(worst, quantised.step / 4) << "the bound is that of this motion";
  EXPECT_LT(quantised.step, 0.0001) << "a tenth of a millimetre";
  EXPECT_LE(quantised.steps.size() * sizeof(quantised.steps[0]), 36'000u);
  // An unseen point stays unseen, and shifts no other.
  points[7] = NotSeen();
  const QuantisedMotion gap = Quantise(points);
  EXPECT_FALSE(IsSeen(gap.At(7)));
  EXPECT_LE(glm::distance(gap.At(8), points[8]), gap.step);
}

TEST(WorldScript, QuantisesWhatStandsStillAndNothingAtAll) {
  BodyMotion still = Walk(1);
  for (glm::dvec3& joint : still.poses[0].joints) joint = {1, 2, 3};
  const QuantisedMotion quantised = Quantise(PointsOf(still));
  EXPECT_EQ(quantised.At(Index(Role::kHead)), glm::dvec3(1, 2, 3));
  EXPECT_TRUE(Quantise({}).steps.empty());
}

TEST(WorldScript, HoldsWhatTheRecordingHolds) {
  RunData run = ExampleRun();
  AddRecordings(run);
  const std::vector<RecordedWorld> worlds = RecordedWorlds(run);
  ASSERT_EQ(worlds.size(), run.recordings.size());
  int checked = 0;
  for (const RecordedWorld& world : worlds) {
    const nlohmann::json json = JsonOf(WorldScript(run, world));
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("file"), world.file);
    const std::vector<Track>& tracks = world.cells.front().recording->tracks;
    ASSERT_EQ(json.at("bodies").size(), tracks.size());
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const nlohmann::json& body = json.at("bodies")[i];
      const BodyMotion& motion = tracks[i].motion;
      ASSERT_EQ(body.at("frames"), motion.poses.size());
      const double bound = body.at("step_m").get<double>() / 2 + 1e-9;
      for (std::size_t f = 0; f < motion.poses.size(); ++f) {
        const std::size_t stored = body.at("data").get_ref<const std::string&>().size() * 3 / 4 / 120;
        for (std::size_t j = 0; j < kRoleCount; ++j, ++checked) {
          for (int axis = 0; axis < 3; ++axis) {
            ASSERT_NEAR(DecodedAt(body, std::min(f, stored - 1), j, axis), motion.poses[f].joints[j][axis], bound);
          }
        }
      }
    }
  }
  EXPECT_GT(checked, 1000);
}

TEST(WorldScript, SaysAgainstWhatAnErrorIsTaken) {
  RunData run = ExampleRun();
  AddRecordings(run);
  int captures = 0;
  for (const RecordedWorld& world : RecordedWorlds(run)) {
    if (world.cells.front().row->task != "capture") continue;
    ++captures;
    const nlohmann::json json = JsonOf(WorldScript(run, world));
    EXPECT_EQ(json.at("unit"), "mm");
    for (const nlohmann::json& body : json.at("bodies")) {
      if (body.at("kind") == "ghost") {
        EXPECT_EQ(body.at("label"), "truth");
      } else {
        ASSERT_EQ(body.at("against").size(), 1u);
        EXPECT_EQ(json.at("bodies")[body.at("against")[0].get<std::size_t>()].at("label"), "truth");
      }
    }
  }
  EXPECT_EQ(captures, 1);
}

TEST(WorldScript, PutsTransitionsAtTheSameRequestAndMarksTheirPoints) {
  RunData run = ExampleRun();
  AddTransitions(run);
  const std::vector<RecordedWorld> worlds = RecordedWorlds(run);
  ASSERT_EQ(worlds.size(), 1u);
  ASSERT_EQ(worlds[0].cells.size(), 3u);
  const nlohmann::json json = JsonOf(WorldScript(run, worlds[0]));
  int points = 0;
  for (const nlohmann::json& mark : json.at("marks")) {
    if (mark.at("kind") != "transition") continue;
    ++points;
    EXPECT_GE(mark.at("frame"), 0);
    if (mark.at("lane") == "gate-inertialised") {
      EXPECT_THAT(mark.at("text").get<std::string>(), HasSubstr("clap frame 28 → side kick frame 4"));
    }
  }
  EXPECT_EQ(points, 1 + 2 + 1);
}

TEST(WorldScript, WritesSharedBodiesOnceAndStillOnesAsOneFrame) {
  RunData run = ExampleRun();
  std::vector<std::string> cells;
  for (const Row& row : run.rows) {
    if (row.task == "capture" && row.trial == run.rows.front().trial) cells.push_back(row.Id());
  }
  ASSERT_GE(cells.size(), 2u);
  BodyMotion truth = Walk(10), recovered = Walk(10);
  for (BodyPose& pose : truth.poses) pose = truth.poses.front();
  for (const std::string& cell : cells) {
    recovered.poses[0][Role::kHead].x += 0.01;
    run.recordings.push_back({cell, Recording({{"truth", truth}, {"recovered", recovered}}, "{}")});
  }
  const auto worlds = RecordedWorlds(run);
  ASSERT_EQ(worlds.size(), 1u);
  const nlohmann::json json = JsonOf(WorldScript(run, worlds[0]));
  ASSERT_EQ(json.at("bodies").size(), 1 + cells.size());
  const nlohmann::json& shared = json.at("bodies")[0];
  EXPECT_EQ(shared.at("cell"), -1);
  EXPECT_EQ(shared.at("frames"), 10);
  EXPECT_EQ(shared.at("data").get<std::string>().size(), 160u);  // 120 bytes
}

TEST(WorldScript, MotionsOfAnyJointsBringTheirTree) {
  RunData run = ExampleRun();
  EvaluationExtras extras;
  extras.truth.rate_hz = 60;
  extras.truth.joints = {"root", "tail"};
  extras.truth.parents = {-1, 0};
  extras.truth.positions = {{0, 1, 0}, {0, 1, -1}, {0, 2, 0}, NotSeen()};
  extras.answer = extras.truth;
  Row& row = run.rows.front();
  row.task = "evaluation";
  run.recordings = {{row.Id(), Recording({}, WriteEvaluationExtras(extras))}};
  const nlohmann::json json = JsonOf(WorldScript(run, RecordedWorlds(run).front()));
  EXPECT_EQ(json.at("rate_hz"), 60);
  ASSERT_EQ(json.at("bodies").size(), 2u);
  const nlohmann::json& body = json.at("bodies").at(1);
  EXPECT_EQ(body.at("joints"), nlohmann::json({"root", "tail"}));
  EXPECT_EQ(body.at("parents"), nlohmann::json({-1, 0}));
  EXPECT_EQ(body.at("frames"), 2);
  EXPECT_EQ(body.at("against"), nlohmann::json({0}));
}

TEST(WorldScript, FaultsOfAMotionAloneAreMarksOnItsFloor) {
  RunData run = ExampleRun();
  Row& row = run.rows.front();
  row.task = "plausibility";
  row.clip = "walk 7";
  const PlausibilityExtras extras{.floor_m = 0.3, .faults = {{"floats", "floats 6 cm from 0.10 to 0.20 s", 3, 6}}};
  run.recordings = {{row.Id(), Recording({{"answer", Walk(10)}}, WriteExtras(extras))}};
  const auto worlds = RecordedWorlds(run);
  const nlohmann::json json = JsonOf(WorldScript(run, worlds.front()));
  EXPECT_THAT(worlds.front().Name(), testing::HasSubstr("walk 7"));
  EXPECT_EQ(json.at("floor_m"), 0.3);
  EXPECT_EQ(json.at("bodies").size(), 1u);
  const nlohmann::json mark = {{"lane", row.method}, {"frame", 3}, {"end", 6}, {"kind", "miss"},
                               {"text", "floats 6 cm from 0.10 to 0.20 s"}};
  EXPECT_EQ(json.at("marks"), nlohmann::json::array({mark}));
}

TEST(WorldScript, ExtrasThatCannotBeReadLeaveTheMotionAndAreTold) {
  RunData run = ExampleRun();
  for (const Row& row : run.rows) {
    if (row.task != "detection") continue;
    run.recordings.push_back({row.Id(), Recording({{"truth", Walk(5)}}, "{\"events\": 3}")});
    break;
  }
  const auto worlds = RecordedWorlds(run);
  ASSERT_EQ(worlds.size(), 1u);
  const nlohmann::json json = JsonOf(WorldScript(run, worlds[0]));
  EXPECT_EQ(json.at("bodies").size(), 1u);
  ASSERT_EQ(json.at("notes").size(), 1u);
  EXPECT_THAT(json.at("notes")[0].get<std::string>(), HasSubstr("cannot be read"));
}

TEST(WorldScript, HostileNamesStayTextAndReachNoPath) {
  RunData run = ExampleRun();
  const std::string hostile = "../</script><b>\xff\n\"";
  for (Row& row : run.rows) {
    if (row.scenario != "capture") continue;
    row.scenario = row.method = hostile;
    run.recordings = {{row.Id(), Recording({{"truth", Walk(3)}}, "{}")}};
  }
  for (ScenarioSummary& scenario : run.scenarios) {
    if (scenario.name == "capture") scenario.name = hostile;
  }
  const auto worlds = RecordedWorlds(run);
  ASSERT_EQ(worlds.size(), 1u);
  EXPECT_EQ(worlds[0].file.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./"),
            std::string::npos);
  EXPECT_EQ(worlds[0].file.find(".."), std::string::npos);
  const std::string index = ViewerIndexHtml(run);
  EXPECT_EQ(index.find("</script><b>"), std::string::npos);
  EXPECT_EQ(WatchHtml(run, worlds[0].scenario).find("<b>"), std::string::npos);
  const std::string script = WorldScript(run, worlds[0]);
  EXPECT_TRUE(JsonOf(script).is_object());
  EXPECT_EQ(script.find('\xff'), std::string::npos);
}

TEST(WorldScript, PagesWithoutRecordingsCarryNoViewer) {
  const RunData run = ExampleRun();
  EXPECT_EQ(ViewerIndexHtml(run), "");
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) EXPECT_EQ(WatchHtml(run, i), "");
}

TEST(WorldScript, TheViewersScriptIsSmall) { EXPECT_LE(ViewerJs().size(), 42'000u); }

}  // namespace
}  // namespace etude
