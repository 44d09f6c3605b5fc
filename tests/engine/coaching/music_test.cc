// Music-time tags against closed forms, with clocks that drift and stutter.

#include "sim/music/music.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/coaching/dance.h"
#include "tests/engine/coaching/small_dance.h"

namespace etude {
namespace {

TEST(MusicAt, IsStraightBetweenTagsAndAtTheJudgedRateBeyond) {
  Dance dance = SmallDance();
  dance.tags = {{.frame = 30, .music_s = 2}, {.frame = 90, .music_s = 5}};
  EXPECT_DOUBLE_EQ(MusicAt(dance, 0), 1);
  EXPECT_DOUBLE_EQ(MusicAt(dance, 30), 2);
  EXPECT_DOUBLE_EQ(MusicAt(dance, 60), 3.5);
  EXPECT_DOUBLE_EQ(MusicAt(dance, 90), 5);
  EXPECT_DOUBLE_EQ(MusicAt(dance, 120), 6);
  dance.tags.clear();
  EXPECT_DOUBLE_EQ(MusicAt(dance, 45), 1.5);
}

TEST(RateToTag, BringsTheDanceToTheTagWithTheMusic) {
  const Dance dance = SmallDance();                             // tags every 3 s
  EXPECT_DOUBLE_EQ(RateToTag(dance, 1, 30, 1.0, 0.5, 2), 1);    // on time
  EXPECT_DOUBLE_EQ(RateToTag(dance, 1, 30, 1.5, 0.5, 2), 1.2);  // half a second late: 3 s of dance in 2.5 s
  EXPECT_DOUBLE_EQ(RateToTag(dance, 1, 30, 0.0, 0.5, 2), 0.75);
  EXPECT_DOUBLE_EQ(RateToTag(dance, 1, 30, 3.9, 0.5, 2), 2);  // the limit
  EXPECT_DOUBLE_EQ(RateToTag(dance, 1, 30, 9.0, 0.5, 2), 2);  // the tag has passed
  EXPECT_DOUBLE_EQ(RateToTag(dance, 1, 30, -9.0, 0.5, 2), 0.5);
}

/// Returns a dance of 40 repetitions of three seconds, one tag each.
Dance LongDance() {
  Dance dance = SmallDance();
  dance.repetitions.clear();
  dance.tags.clear();
  dance.motion = Flap(40 * kRepetitionFrames + 60, 60);
  for (int i = 0; i < 40; ++i) {
    const std::size_t first = 30 + i * kRepetitionFrames;
    dance.repetitions.push_back({.move = 0, .first = first, .end = first + kRepetitionFrames});
    dance.tags.push_back({.frame = first, .music_s = first / kJudgedRateHz});
  }
  return dance;
}

/// Returns the beat errors (s) of every frame of an uninterrupted session of two minutes.
std::vector<double> BeatErrors(const MusicClockOptions& music, bool follows_tags, int trial) {
  static const DanceLibrary library = DanceLibrary::Make(LongDance()).value();
  const DanceTransitions transitions(library, {.choice = FindChoice("now"), .join = FindJoin("cut")});
  const Coach coach(transitions, {.idle_s = 1000, .follows_tags = follows_tags}, {FindPolicy("never"), {}});
  MusicClock clock(music, {.suite_seed = 3, .scenario = "music", .trial = trial});
  CoachState state = coach.BeginDancing();
  const SensedFrame nobody;
  const FeatureFrame features;
  std::vector<double> errors;
  while (state.mode == CoachMode::kDance) {
    clock.Tick();
    CoachInput input{.seen = {nobody, features}};
    if (clock.IsPlaying()) input.music_s = clock.Now();
    CoachStep step = coach.Step(std::move(state), input);
    state = std::move(step.state);
    if (step.output.music.kind == MusicCommand::Kind::kPlayFrom) clock.PlayFrom(step.output.music.music_s);
    if (step.output.beat_error_s) errors.push_back(*step.output.beat_error_s);
  }
  return errors;
}

double P95(std::vector<double> errors) {
  for (double& error : errors) error = std::abs(error);
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(errors.size()));
  std::ranges::nth_element(errors, at);
  return *at;
}

TEST(Tags, WithoutThemAClockThatDriftsRunsAwayInAStraightLine) {
  const std::vector<double> errors = BeatErrors({.drift = 0.02}, false, 0);
  for (std::size_t i = 0; i < errors.size(); i += 100) EXPECT_NEAR(errors[i], 0.02 * (i + 1) / 30, 1e-9);
}

TEST(Tags, WithThemADriftIsMadeUpForMoveByMove) {
  // If the dance is late by e at a tag, it dances a move of T seconds in T − e. Meanwhile the music plays (1 + d)(T −
  // e), so the next tag is late by e' = d (T − e), which tends to d T / (1 + d).
  const std::vector<double> errors = BeatErrors({.drift = 0.02}, true, 0);
  // From the middle to the last tag, four seconds before the end of the dance.
  const auto late = std::span(errors).subspan(errors.size() / 2, errors.size() / 2 - 130);
  EXPECT_NEAR(*std::ranges::max_element(late), 0.02 * 3 / 1.02, 0.002);
  EXPECT_NEAR(*std::ranges::min_element(late), 0.02 * 3 / 1.02, 0.002);
}

TEST(Tags, AClockThatRunsTrueIsDancedWithoutAnError) {
  for (double error : BeatErrors({}, true, 0)) ASSERT_NEAR(error, 0, 1e-9);
}

TEST(Tags, AtLeastHalveTheErrorOfClocksThatDriftAndStutter) {
  for (double drift : {-0.02, 0.0, 0.02}) {
    for (double per_min : {0.0, 6.0, 20.0}) {
      if (drift == 0 && per_min == 0) continue;
      std::vector<double> with, without;
      for (int trial = 0; trial < 5; ++trial) {
        const MusicClockOptions music{.drift = drift, .stutters_per_min = per_min, .stutter_s = 0.2};
        for (double error : BeatErrors(music, true, trial)) with.push_back(error);
        for (double error : BeatErrors(music, false, trial)) without.push_back(error);
      }
      RecordProperty("p95_ms", std::to_string(1000 * P95(with)) + " " + std::to_string(1000 * P95(without)));
      EXPECT_LE(P95(with), 0.5 * P95(without)) << drift << " " << per_min;
    }
  }
}

}  // namespace
}  // namespace etude
