#include "engine/transitions/in_betweens/in_between_net.h"

#include <gtest/gtest.h>

#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

/// A clip of these levels, of which each frame has the tags of its class, a digit. All are bridge frames.
TaggedClip ClipOfClasses(const std::vector<double>& levels, const std::string& classes) {
  std::vector<int> frames;
  for (std::size_t f = 0; f < levels.size(); ++f) frames.push_back(static_cast<int>(f));
  TaggedClip clip = ClipOfLevels(levels, frames);
  for (std::size_t f = 0; f < levels.size(); ++f) clip.tags[f][0] = static_cast<std::uint8_t>(classes[f] - '0');
  return clip;
}

std::vector<double> LevelsOf(const InBetweenNet& net, const std::vector<TaggedClip>& clips) {
  std::vector<double> levels;
  for (const InBetweenNet::Key& key : net.keys) levels.push_back(clips[key.clip].grades[key.frame][0]);
  return levels;
}

// Class 0 occurs in one clip and eight frames, 1 in two and four, 2 in two and five, 3 in three and three; each lies
// apart from the rest.
TEST(InBetweenNet, TakesItsKeysFromTheMostFrequentPoseToTheRarest) {
  const std::vector<TaggedClip> clips = {
      ClipOfClasses({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0}, "00000000112223"),
      ClipOfClasses({1.0, 1.0, 2.0, 2.0, 3.0}, "11223"), ClipOfClasses({3.0}, "3")};
  EXPECT_EQ(LevelsOf(BuildInBetweens(clips), clips), (std::vector{3.0, 2.0, 1.0, 0.0}))
      << "by clips, and of as many clips by frames";
}

TEST(InBetweenNet, PutsThePoseOfMoreFramesFirstAmongThoseOfAsManyClips) {
  const std::vector<TaggedClip> clips = {ClipOfClasses({1.0, 2.0, 2.0}, "122"), ClipOfClasses({1.0, 2.0}, "12")};
  EXPECT_EQ(LevelsOf(BuildInBetweens(clips), clips), (std::vector{2.0, 1.0}));
}

TEST(InBetweenNet, TakesTheMostTypicalFrameOfAPoseForItsKey) {
  // Root mean squares of the distances to the other clips' frames: 0.26, 0.18, 0.36, all within the threshold.
  const std::vector<TaggedClip> clips = {ClipOfClasses({1.00}, "1"), ClipOfClasses({1.05}, "1"),
                                         ClipOfClasses({1.30}, "1")};
  EXPECT_EQ(LevelsOf(BuildInBetweens(clips), clips), std::vector{1.05});
}

TEST(InBetweenNet, HasAKeyNearEveryBridgeFrameAndNoTwoKeysNearEachOther) {
  std::vector<TaggedClip> clips;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> levels;
    for (int f = 0; f < 40; ++f) levels.push_back(2 + 2 * std::sin(0.3 * f + c));
    clips.push_back(ClipOfClasses(levels, std::string(40, '1')));
  }
  for (double threshold : {0.2, 0.4, 1.0}) {
    const std::vector<double> keys = LevelsOf(BuildInBetweens(clips, {.threshold = threshold, .tween = {}}), clips);
    for (const TaggedClip& clip : clips) {
      for (const Grades& frame : clip.grades) {
        double nearest = 1e9;
        for (double key : keys) nearest = std::min(nearest, std::abs(key - frame[0]));
        EXPECT_LT(nearest, threshold);
      }
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) EXPECT_GE(std::abs(keys[i] - keys[k]), threshold);
    }
    EXPECT_GE(keys.size(), 4 / (2 * threshold)) << "levels from 0 to 4";
  }
}

TEST(InBetweenNet, IsMadeOfBridgeFramesWhereThereAreAnyElseOfAllFrames) {
  std::vector<TaggedClip> clips = {ClipOfClasses({0, 5, 9}, "111"), ClipOfClasses({0, 5, 9}, "111")};
  clips[0].bridge_frames = {1};
  clips[1].bridge_frames = {};
  EXPECT_EQ(LevelsOf(BuildInBetweens(clips), clips), std::vector{5.0});
  clips[0].bridge_frames = {};
  EXPECT_EQ(BuildInBetweens(clips).keys.size(), 3u);
}

TEST(InBetweenNet, TakesAtMostTwoOfTheLongestTweensInWholeFrames) {
  // Half a turn, eased, lasts 1.875 / 2 s at one turn a second: 28.125 frames of 30 a second, so 29.
  EXPECT_NEAR(LongestInBetween({}, 30), 2 * 29 / 30.0, 1e-12);
}

}  // namespace
}  // namespace etude
