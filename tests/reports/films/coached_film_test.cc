#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/model/recording.h"
#include "reports/films/coached_scene.h"
#include "sim/choreography/move.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Renderer& Drawing() {
  static const auto renderer = SharedRenderer();
  EXPECT_TRUE(renderer.has_value());
  return **renderer;
}

Camera FrontCamera() {
  Intrinsics inside{.width = 320, .height = 132};
  inside.fx = inside.fy = 275;
  inside.cx = 160;
  inside.cy = 66;
  return LookAt(inside, {0, 1.35, 5.2}, {0, 1, 0});
}

TEST(Forest, HidesTheRoom) {
  const auto pixels = [](std::uint64_t room, const std::vector<Figure>& figures) {
    return Drawing()
        .Render({.texture_seed = room, .casts_shadows = false}, figures, FrontCamera(), Targets::kColour)
        .colour.pixels;
  };
  EXPECT_EQ(pixels(1, {ForestFigure()}), pixels(2, {ForestFigure()}));
  EXPECT_NE(pixels(1, {}), pixels(2, {}));  // the control: other rooms differ
}

TEST(Forest, LeavesTheStageToTheDancers) {
  for (const Surface& surface : ForestFigure().surfaces) {
    const bool is_meadow = std::ranges::all_of(surface.positions, [](const auto& p) { return p.y < 0.01; });
    for (const glm::dvec3& corner : surface.positions) EXPECT_TRUE(is_meadow || corner.z < -1) << corner.z;
  }
}

TEST(Forest, SpotsLieOnTheMeadowBetweenTheFeet) {
  BodyPose pose = LoadBuiltinMove("clap")->motion.poses.front();
  const auto width_of = [](const Surface& spot) {
    const auto [least, most] = std::ranges::minmax(spot.positions, {}, &glm::dvec3::x);
    return most.x - least.x;
  };
  const Surface narrow = SpotBelow(pose);
  pose[Role::kLeftAnkle].x += 0.5;
  const Surface wide = SpotBelow(pose);
  EXPECT_NEAR(width_of(wide) - width_of(narrow), 0.5, 0.02);
  for (const glm::dvec3& corner : wide.positions) EXPECT_GT(corner.y, 0.004);  // height of the meadow
}

/// Ten seconds with a mistake from frame 60 to 150, which is answered until frame 250.
Recording SessionRecording() {
  const BodyMotion dance = LoadBuiltinMove("clap")->motion;
  BodyMotion motion{.rate_hz = kJudgedRateHz, .poses = {}};
  for (std::size_t frame = 0; frame < 300; ++frame) motion.poses.push_back(dance.poses[frame % dance.poses.size()]);
  CoachExtras extras{.song = "groove", .modes = {{"dance", 0}, {"correct", 152}, {"dance", 250}}};
  extras.performances = {
      {.move = "clap", .truth = "wrong", .called = "right", .begin_frame = 60, .end_frame = 150, .faults = "skipped"}};
  extras.words = {{.begin_frame = 0, .say = "", .hint = "both arms up", .picture = {}}};
  extras.decisions = {{150, "wrong", "not reached"}};
  extras.corrections = {150};
  extras.transitions = {152, 250};
  extras.beats_s = {0.5, 1.0, 4.5, 9.9};
  return {{{"coach", motion}, {"truth", motion}, {"sensed", motion}}, WriteExtras(extras)};
}

/// A recorded cell. The result of `Cell` points to the members, so this object must not move.
struct RecordedSession {
  ScenarioSummary scenario;
  Row row;
  Recording recording = SessionRecording();
  ShownCell Cell() const { return {&scenario, &row, &recording}; }
};

TEST(CoachedSession, ReadsWhatTheTaskKeeps) {
  const RecordedSession recorded;
  ASSERT_OK(facts, ReadCoachedSession(recorded.Cell()));
  EXPECT_EQ(facts->Frames(), 300);
  EXPECT_EQ(facts->modes[1].mode, "correct");
  EXPECT_EQ(facts->performances[0].truth, "wrong");
  EXPECT_THAT(facts->transitions, ElementsAre(152, 250));
  EXPECT_THAT(facts->beats_s, ElementsAre(0.5, 1.0, 4.5, 9.9));
}

TEST(CoachedSession, RefusesWhatIsNone) {
  RecordedSession recorded;
  recorded.recording.tracks[1].motion.poses.pop_back();
  auto facts = ReadCoachedSession(recorded.Cell());
  ASSERT_FALSE(facts.has_value());
  EXPECT_THAT(ToString(facts.error()), HasSubstr("the tracks 'coach', 'truth' and 'sensed' differ in length"));
  recorded.recording.tracks.pop_back();
  facts = ReadCoachedSession(recorded.Cell());
  ASSERT_FALSE(facts.has_value());
  EXPECT_THAT(ToString(facts.error()), HasSubstr("no track 'sensed'"));
  recorded.recording = SessionRecording();
  recorded.recording.extras_json = R"({"song": 3})";
  facts = ReadCoachedSession(recorded.Cell());
  ASSERT_FALSE(facts.has_value());
  EXPECT_THAT(ToString(facts.error()), HasSubstr("not those of a coached session"));
}

TEST(CoachedSession, TheWorstIsWhoWasNeedlesslyCorrectedAndMissedMost) {
  RunData run;
  run.scenarios.emplace_back().name = "loop";
  for (int trial = 0; trial < 3; ++trial) {
    Row row;
    row.scenario = "loop";
    row.method = "a";
    row.trial = trial;
    row.result.Measure("corrections_unneeded_per_min", trial == 1 ? 0.5 : 0.0);
    row.result.Measure("corrections_missed_per_min", trial == 2 ? 0.4 : 0.0);
    run.recordings.push_back({row.Id(), SessionRecording()});
    run.rows.push_back(row);
  }
  ASSERT_OK(worst, ChooseWorstSession(run, run.scenarios.front()));
  EXPECT_EQ(worst->row->trial, 1);
  run.recordings.clear();
  EXPECT_FALSE(ChooseWorstSession(run, run.scenarios.front()).has_value());
}

constexpr int kWholeSession = 100000;

CoachedScene SceneOf(int longest) {
  const RecordedSession recorded;
  return {*ReadCoachedSession(recorded.Cell()), "test", longest, Drawing()};
}

TEST(CoachedScene, IsCutAroundTheFirstCorrectionOrWhole) {
  CoachedScene cut = SceneOf(150), whole = SceneOf(kWholeSession);
  EXPECT_EQ(cut.Frames(), 150);
  EXPECT_EQ(whole.Frames(), 300);
  EXPECT_EQ(whole.PosterFrame(), 152 + kFilmRate);
  EXPECT_EQ(cut.PosterFrame(), 152 + kFilmRate - 60);  // it begins three seconds before the correction
  EXPECT_THAT(cut.Words(), HasSubstr("seconds 2 to 7 of 10"));
}

TEST(CoachedScene, ClicksWhereTheMusicsBeatsFall) {
  EXPECT_THAT(SceneOf(kWholeSession).Beats(), ElementsAre(0.5, 1.0, 4.5, 9.9));
  EXPECT_THAT(SceneOf(120).Beats(), ElementsAre(2.5));
}

int CountInRow(const ColourImage& picture, const Rgb8& colour, int row) {
  int count = 0;
  for (int x = 0; x < picture.width; ++x) {
    const Rgb8& p = picture.At(x, row);
    count += std::abs(p.r - colour.r) < 3 && std::abs(p.g - colour.g) < 3 && std::abs(p.b - colour.b) < 3;
  }
  return count;
}

TEST(CoachedScene, ShowsAJudgementOnlyOnceItWasMade) {
  constexpr Rgb8 kRightGreen{92, 189, 117}, kWrongRed{224, 92, 82};
  constexpr int kTruthRow = 640, kJudgedRow = 674;  // rows through the bars
  CoachedScene scene = SceneOf(kWholeSession);
  const ColourImage before = scene.Draw(140).Pixels(), after = scene.Draw(160).Pixels();
  EXPECT_GT(CountInRow(before, kWrongRed, kTruthRow), 200);
  EXPECT_EQ(CountInRow(before, kRightGreen, kJudgedRow), 0);
  EXPECT_GT(CountInRow(after, kRightGreen, kJudgedRow), 200);
}

TEST(CoachedScene, DrawsTheSamePixelsWhateverWasDrawnBefore) {
  CoachedScene one = SceneOf(120), other = SceneOf(120);
  one.Draw(3);
  EXPECT_EQ(one.Draw(50).Pixels().pixels, other.Draw(50).Pixels().pixels);
}

}  // namespace
}  // namespace etude
