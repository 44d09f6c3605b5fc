#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/metrics/transition_smoothness.h"
#include "io/drawing/look.h"
#include "reports/films/transition_plots.h"
#include "reports/films/transition_race.h"
#include "reports/films/transition_scene.h"
#include "tests/reports/support/example_run.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

RunData Recorded() {
  RunData run = ExampleRun();
  AddRecordings(run);
  AddTransitions(run);
  return run;
}

TransitionRace ExampleRace() {
  const RunData run = Recorded();
  auto race = FindTransitionRace(run, run.scenarios.front());
  EXPECT_TRUE(race.has_value()) << ToString(race.error());
  return *std::move(race);
}

int CountPixels(const ColourImage& picture, const Paint& paint) {
  const auto near = [](std::uint8_t shown, double wanted) { return std::abs(shown - 255 * wanted) < 2; };
  return static_cast<int>(std::ranges::count_if(
      picture.pixels, [&](const Rgb8& p) { return near(p.r, paint.r) && near(p.g, paint.g) && near(p.b, paint.b); }));
}

TEST(TransitionRace, TakesTheFirstWorldThatMostMethodsRecorded) {
  const TransitionRace race = ExampleRace();
  EXPECT_EQ(race.world, "trial 7");
  ASSERT_EQ(race.paths.size(), 3u);
  EXPECT_EQ(race.paths[1].method, "fuzzy-bridge");
}

TEST(TransitionRace, AlignsEveryoneAtTheRequest) {
  const TransitionRace race = ExampleRace();
  EXPECT_EQ(race.paths[0].FirstPoint(), 0);
  EXPECT_EQ(race.paths[1].FirstPoint(), 10);
  EXPECT_EQ(race.paths[1].LastPoint(), 25);
  EXPECT_EQ(race.paths[2].LastPoint(), 8);
  EXPECT_EQ(race.paths[1].PointsBefore(10), 0u);  // in the frame of the transition point, the old clip still plays
  EXPECT_EQ(race.paths[1].PointsBefore(11), 1u);
  EXPECT_EQ(race.paths[1].FrameAt(-1000), 0);
  EXPECT_FALSE(race.paths[1].IsRecordedAt(-61));
  EXPECT_EQ(race.paths[0].jumps_cm, SecondDifferencesCm(race.paths[0].motion));
}

TEST(TransitionRace, ShowsAlsoOneMethodAndNeedsARecordedPoint) {
  RunData run = ExampleRun();
  auto race = FindTransitionRace(run, run.scenarios.front());
  ASSERT_FALSE(race.has_value());
  EXPECT_THAT(ToString(race.error()), HasSubstr("key 'video'"));
  AddRecordings(run);
  race = FindTransitionRace(run, run.scenarios.front());
  ASSERT_TRUE(race.has_value()) << ToString(race.error());
  EXPECT_EQ(race->paths.size(), 1u);
  run.recordings.front().recording.extras_json = R"({"from": "clap"})";
  EXPECT_THAT(testing::Refusal(FindTransitionRace(run, run.scenarios.front())), HasSubstr("'transition_frame'"));
}

TEST(TransitionClock, PlaysOnceAndThenTheSwitchesSlowly) {
  const TransitionClock clock(ExampleRace());
  EXPECT_EQ(clock.TimeAt(0), clock.First());
  EXPECT_EQ(clock.TimeAt(clock.FrameOf(0)), 0);
  EXPECT_LT(clock.First(), 0);
  EXPECT_GT(clock.Last(), 25);
  int slow_points = 0;
  for (int frame = 1; frame < clock.Frames(); ++frame) {
    const int step = clock.TimeAt(frame) - clock.TimeAt(frame - 1);
    const bool begins_again = clock.IsSlow(frame) && !clock.IsSlow(frame - 1);
    EXPECT_TRUE(begins_again || step == 0 || step == 1) << frame;
    slow_points += clock.IsSlow(frame) && (clock.TimeAt(frame) == 0 || clock.TimeAt(frame) == 25);
  }
  EXPECT_EQ(slow_points, 2 * TransitionClock::kSlowness);
}

TEST(TransitionClock, DoesNotWaitForWhoWaitsTooLong) {
  TransitionRace race = ExampleRace();
  const int frames = TransitionClock(race).Frames();
  race.paths.push_back(race.paths.front());
  race.paths.back().request = -5000;
  EXPECT_EQ(TransitionClock(race).Frames(), frames);
}

TEST(Countdown, RunsFromTheRequestToTheSwitch) {
  EXPECT_EQ(CountdownWords("clap", -1, 15, 30), "");
  EXPECT_EQ(CountdownWords("clap", 0, 15, 30), "clap in 0.50 s");
  EXPECT_EQ(CountdownWords("clap", 16, 15, 30), "waited 0.50 s");
}

TEST(DistanceBars, AreAsLongAsTheirShareOfTheThreshold) {
  TransitionFacts facts;
  facts.threshold = 0.4;
  facts.points.resize(1);
  const auto amber = [&](double partial) {
    PerFeature partials{};
    partials[0] = partial;
    facts.points[0].partials = partials;
    Canvas canvas(420, static_cast<int>(kDistanceBarsHeight));
    DrawDistanceBars(canvas, {0, 0, 420, kDistanceBarsHeight}, facts, 0);
    return CountPixels(canvas.Pixels(), kWarm);
  };
  EXPECT_EQ(amber(0), 0);
  const int quarter = amber(0.04), half = amber(0.08);
  EXPECT_GT(quarter, 50);
  EXPECT_NEAR(half, 2 * quarter, quarter / 2);
  EXPECT_EQ(amber(0.2), 0);  // only the part above the threshold, in another colour
}

TEST(DistanceBars, TellDistanceThresholdAndBranch) {
  const TransitionRace race = ExampleRace();
  EXPECT_EQ(PointWords(race.paths[0].facts, 0), "distance 0.500 ≥ 0.4 · now");
  EXPECT_EQ(PointWords(race.paths[1].facts, 1), "2 of 2 · distance 0.350 < 0.4 · in-between");
}

TEST(TransitionScene, DrawsTheSamePixelsEveryTimeAndMarksTheChange) {
  ASSERT_OK(renderer, SharedRenderer());
  const TransitionRace race = ExampleRace();
  const TransitionClock clock(race);
  TransitionScene scene(race, "transition", **renderer);
  const int before = clock.FrameOf(-5), after = clock.FrameOf(3);
  const ColourImage calm = scene.Draw(before).Pixels(), changed = scene.Draw(after).Pixels();
  // "now" has just changed: its column is framed and its bars are filled.
  EXPECT_GT(CountPixels(changed, kWarm), CountPixels(calm, kWarm) + 1500);
  TransitionScene again(race, "transition", **renderer);
  EXPECT_EQ(again.Draw(after).Pixels().pixels, changed.pixels);
  EXPECT_THAT(scene.Words(), HasSubstr("as solved by 3 methods, from left to right: "));
  EXPECT_THAT(scene.Words(), HasSubstr("fuzzy-bridge (in-between, after 0.83 s)"));
}

TEST(TransitionScene, GivesTheWholeFrameToOneMethod) {
  ASSERT_OK(renderer, SharedRenderer());
  TransitionRace race = ExampleRace();
  race.paths.erase(race.paths.begin() + 1, race.paths.end());
  TransitionScene scene(race, "transition", **renderer);
  EXPECT_THAT(scene.Words(), HasSubstr("as solved by now ("));
  // The column has no empty stripe: the share of pixels with the colour of the background is small.
  const ColourImage picture = scene.Draw(scene.PosterFrame()).Pixels();
  const Rgb8 background = BeginFrame("").Pixels().At(2, 400);
  int empty = 0, all = 0;
  for (int y = 60; y < 700; ++y) {
    for (int x = 20; x < 1260; ++x, ++all) empty += picture.At(x, y) == background;
  }
  EXPECT_LT(static_cast<double>(empty) / all, 0.05);
}

}  // namespace
}  // namespace etude
