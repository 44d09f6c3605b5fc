#include "sim/music/music.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/formats/wav.h"

namespace etude {
namespace {

constexpr WorldKey kMusicWorld{.suite_seed = 1, .scenario = "music", .trial = 0};

TEST(MusicClock, WithoutFaultsIsAClock) {
  MusicClock clock({}, kMusicWorld);
  clock.Tick();
  EXPECT_EQ(clock.Now(), 0) << "silent until it is told to play";
  clock.PlayFrom(10);
  for (int i = 0; i < 300; ++i) clock.Tick();
  EXPECT_NEAR(clock.Now(), 20, 1e-9);
  clock.Pause();
  clock.Tick();
  EXPECT_NEAR(clock.Now(), 20, 1e-9);
}

TEST(MusicClock, Drifts) {
  MusicClock clock({.drift = -0.02}, kMusicWorld);
  clock.PlayFrom(0);
  for (int i = 0; i < 3000; ++i) clock.Tick();
  EXPECT_NEAR(clock.Now(), 98, 1e-9);
}

/// Returns the frames of a minute in which the clock stands still.
std::vector<int> Standing(MusicClock clock) {
  std::vector<int> frames;
  clock.PlayFrom(0);
  for (int i = 0; i < 1800; ++i) {
    const double before = clock.Now();
    clock.Tick();
    if (clock.Now() == before) frames.push_back(i);
  }
  return frames;
}

TEST(MusicClock, StuttersAsOftenAndAsLongAsItIsTold) {
  int frames = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const WorldKey world{.suite_seed = 1, .scenario = "music", .trial = trial};
    frames += static_cast<int>(Standing(MusicClock({.stutters_per_min = 6, .stutter_s = 0.2}, world)).size());
  }
  EXPECT_NEAR(frames / 100.0, 6 * 6, 5);  // six stutters of six frames
}

TEST(MusicClock, StuttersAtTheSameFramesWhateverItIsTold) {
  const MusicClockOptions options{.stutters_per_min = 20, .stutter_s = 0.2};
  MusicClock paused(options, kMusicWorld);
  std::vector<int> frames;
  paused.PlayFrom(5);
  for (int i = 0; i < 1800; ++i) {
    if (i == 300) paused.Pause();
    if (i == 600) paused.PlayFrom(1);
    const double before = paused.Now();
    paused.Tick();
    if (paused.IsPlaying() && paused.Now() == before) frames.push_back(i);
  }
  std::vector<int> expected = Standing(MusicClock(options, kMusicWorld));
  std::erase_if(expected, [](int frame) { return frame >= 300 && frame < 600; });
  EXPECT_EQ(frames, expected);
}

TEST(ClickTrack, ClicksOnTheBeatAndIsSilentElsewhere) {
  const std::vector<double> beats = {0.5, 1.0, 99};
  const std::vector<double> samples = ClickTrack(beats, 1.5, 8000);
  ASSERT_EQ(samples.size(), 12000U);
  const auto loudest = [&](int from, int to) {
    double most = 0;
    for (int i = from; i < to; ++i) most = std::max(most, std::abs(samples[i]));
    return most;
  };
  EXPECT_EQ(loudest(0, 4000), 0);
  EXPECT_GT(loudest(4000, 4040), 0.4);
  EXPECT_EQ(loudest(4300, 8000), 0);
  EXPECT_GT(loudest(8000, 8040), 0.4);
  EXPECT_LE(loudest(0, 12000), 1);
}

TEST(WriteWav, WritesAHeadAndSamplesAsTheyStandInTheFormat) {
  const std::vector<double> samples = {0, 1, -1, 7};
  const std::string wav = WriteWav(samples, 44100);
  ASSERT_EQ(wav.size(), 44U + 8);
  EXPECT_EQ(wav.substr(0, 4), "RIFF");
  EXPECT_EQ(wav.substr(8, 8), "WAVEfmt ");
  EXPECT_EQ(wav.substr(24, 4), std::string("\x44\xAC\x00\x00", 4));  // 44100 Hz
  EXPECT_EQ(wav.substr(36, 4), "data");
  EXPECT_EQ(wav.substr(44), std::string("\x00\x00\xFF\x7F\x01\x80\xFF\x7F", 8));
}

}  // namespace
}  // namespace etude
