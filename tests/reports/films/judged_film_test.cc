#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/model/recording.h"
#include "reports/films/judged_scene.h"
#include "sim/choreography/move.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Move& Clap() {
  static const Move move = *LoadBuiltinMove("clap");
  return move;
}

/// Returns a recording of ten seconds. Clap is requested twice: first the person dances it as taught, from frame 30
/// on; then the person stands still.
Recording SessionRecording(bool calls_right) {
  const BodyMotion& dance = Clap().motion;
  const auto end = static_cast<int>(30 + dance.poses.size());
  BodyMotion motion{.rate_hz = kJudgedRateHz, .poses = {}};
  for (int frame = 0; frame < 300; ++frame) {
    const bool dances = frame >= 30 && frame < end;
    motion.poses.push_back(dance.poses[dances ? static_cast<std::size_t>(frame - 30) : 0]);
  }
  DetectionExtras extras{.threshold = 0.5};
  DetectionExtras::Move& taught = extras.moves.emplace_back();
  taught.name = "clap";
  for (const KeyPose& pose : Clap().key_poses) {
    auto& told = taught.key_poses.emplace_back();
    for (const KeyPose::Target& target : pose.targets) {
      told.push_back({std::string(target.feature), target.degrees, target.tolerance_deg});
    }
  }
  extras.joint_states.assign(300, std::string(kRoleCount, 't'));
  extras.events = {{.move = "clap", .truth = "right", .fault = "none", .danced = "clap"},
                   {.move = "clap", .truth = "wrong", .fault = "skipped", .danced = ""}};
  extras.events[0].begin_frame = 30;
  extras.events[0].end_frame = extras.events[1].begin_frame = end;
  extras.events[1].end_frame = 290;
  if (calls_right) extras.events[0].called_frame = end - 10;
  extras.alarms = {{"sway", 20}};
  return {{{"truth", motion}, {"sensed", motion}}, WriteExtras(extras)};
}

/// Two methods in one world; the first judges both correctly.
struct RecordedWorld {
  RunData run;

  RecordedWorld() {
    run.scenarios.emplace_back().name = "judged";
    for (const char* method : {"sharp", "deaf"}) {
      Row row;
      row.scenario = "judged";
      row.method = method;
      run.recordings.push_back({row.Id(), SessionRecording(row.method == "sharp")});
      run.rows.push_back(row);
    }
  }
  ShownCell Cell(std::size_t i) const { return {&run.scenarios.front(), &run.rows[i], &run.recordings[i].recording}; }
};

TEST(JudgedSession, TicksKeyPosesOffAsTheyAreDanced) {
  const RecordedWorld world;
  ASSERT_OK(facts, ReadJudgedSession(world.run, world.Cell(0)));
  ASSERT_EQ(facts->performances.size(), 2);
  const auto& danced = facts->performances[0];
  ASSERT_EQ(danced.reached.size(), Clap().key_poses.size());
  int before = 30;
  for (const auto& when : danced.reached) {
    ASSERT_TRUE(when.has_value());
    EXPECT_GE(*when, before);
    before = *when;
  }
  EXPECT_LT(before, danced.end_frame);
  EXPECT_FALSE(facts->performances[1].reached.back().has_value()) << "nobody danced";
}

TEST(JudgedSession, PutsTheOtherMethodsOfTheWorldBeside) {
  const RecordedWorld world;
  ASSERT_OK(facts, ReadJudgedSession(world.run, world.Cell(1)));
  ASSERT_EQ(facts->judges.size(), 2);
  EXPECT_EQ(facts->judges[0].method, "deaf");
  EXPECT_FALSE(facts->judges[0].called_right[0].has_value());
  EXPECT_EQ(facts->judges[1].method, "sharp");
  EXPECT_TRUE(facts->judges[1].called_right[0].has_value());
  EXPECT_EQ(facts->judges[1].alarms.front().frame, 20);
}

TEST(JudgedSession, RefusesWhatIsNone) {
  RecordedWorld world;
  world.run.recordings[0].recording.extras_json = R"({"events": 3})";
  auto facts = ReadJudgedSession(world.run, world.Cell(0));
  ASSERT_FALSE(facts.has_value());
  EXPECT_THAT(ToString(facts.error()), HasSubstr("the extras do not fit the session"));
  world.run.recordings[0].recording.tracks.pop_back();
  facts = ReadJudgedSession(world.run, world.Cell(0));
  ASSERT_FALSE(facts.has_value());
  EXPECT_THAT(ToString(facts.error()), HasSubstr("has no tracks"));
}

int CountInRow(const ColourImage& picture, const Paint& paint, int row) {
  const auto near = [](double share, int level) { return std::abs(255 * share - level) < 3; };
  int count = 0;
  for (int x = 100; x < picture.width; ++x) {
    const Rgb8& p = picture.At(x, row);
    count += near(paint.r, p.r) && near(paint.g, p.g) && near(paint.b, p.b);
  }
  return count;
}

TEST(JudgedScene, ShowsAJudgementOnlyOnceItWasMade) {
  constexpr int kTruthRow = 600, kFirstJudge = 634;  // rows through the bars
  const RecordedWorld world;
  JudgedScene scene(*ReadJudgedSession(world.run, world.Cell(0)), "test", 100000);
  EXPECT_EQ(scene.Frames(), 300);
  const ColourImage before = scene.Draw(35).Pixels(), after = scene.Draw(280).Pixels();
  EXPECT_GT(CountInRow(before, kRightPaint, kTruthRow), 100);
  EXPECT_EQ(CountInRow(before, kRightPaint, kFirstJudge), 0);
  EXPECT_GT(CountInRow(after, kRightPaint, kFirstJudge), 100);
}

TEST(JudgedScene, ADamagedRecordingsEventWithoutAFrameIsDrawn) {
  const RecordedWorld world;
  JudgedSessionFacts facts = *ReadJudgedSession(world.run, world.Cell(0));
  facts.evidence.assign(300, 0.5);
  facts.performances[0].begin_frame = facts.performances[0].end_frame = 0;
  JudgedScene scene(std::move(facts), "test", 100000);
  EXPECT_GT(scene.Draw(10).Pixels().width, 0);
}

TEST(JudgedScene, IsCutToWhatComesBeforeTheFirstMistake) {
  const RecordedWorld world;
  JudgedScene scene(*ReadJudgedSession(world.run, world.Cell(1)), "test", 120);
  EXPECT_EQ(scene.Frames(), 120);
  EXPECT_THAT(scene.Words(), HasSubstr("seconds 0 to 4 of 10"));
}

}  // namespace
}  // namespace etude
