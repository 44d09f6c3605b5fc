#include "engine/transitions/bridge_frames/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// 30 frames of which 10 and 14 match the second clip, and a third clip that matches nothing.
std::vector<TaggedClip> ThreeClips() {
  std::vector<double> levels(30, 5.0);
  levels[10] = levels[14] = levels[20] = 0;
  return {ClipOfLevels(levels, {2, 10, 14}), ClipOfLevels({0, 0, 0, 0}, {0, 1}), ClipOfLevels({9, 9, 9}, {0, 1})};
}

TEST(Coverage, NamesTheClipsWithoutAWay) {
  const Coverage coverage(ThreeClips(), {}, 1);
  EXPECT_THAT(coverage.WithoutWayInto(1), ElementsAre(2));
  EXPECT_THAT(coverage.WithoutWayInto(2), ElementsAre(0, 1));
  EXPECT_THAT(Coverage(ThreeClips(), {.threshold = 20}, 1).WithoutWayInto(2), IsEmpty());
}

TEST(Coverage, SharesAreOfAllFramesAndOfBridgeFrames) {
  const Coverage coverage(ThreeClips(), {}, 1);
  EXPECT_DOUBLE_EQ(coverage.Of(0, 1).frame_share, 3.0 / 30);
  EXPECT_DOUBLE_EQ(coverage.Of(0, 1).bridge_share, 2.0 / 3);
  EXPECT_DOUBLE_EQ(coverage.Of(1, 0).bridge_share, 1.0);
  EXPECT_DOUBLE_EQ(coverage.Of(0, 2).bridge_share, 0.0);
}

TEST(Coverage, WaitsOverTheEndOfAClipThatStartsOver) {
  const Coverage coverage(ThreeClips(), {}, 1);
  ASSERT_TRUE(coverage.Of(0, 1).worst_wait_s);
  EXPECT_NEAR(*coverage.Of(0, 1).worst_wait_s, 25.0 / 30, 1e-12) << "from frame 15 over the end to frame 10";
  EXPECT_FALSE(coverage.Of(0, 2).worst_wait_s);
}

TEST(Coverage, NeedsAnInBetweenWhereNoMatchComesWithinTheBudget) {
  EXPECT_DOUBLE_EQ(Coverage(ThreeClips(), {}, 1).Of(0, 1).in_between_share, 15.0 / 30) << "frames 15 to 29";
  EXPECT_DOUBLE_EQ(Coverage(ThreeClips(), {}, 0.1).Of(0, 1).in_between_share, 22.0 / 30)
      << "three frames of waiting: only from 7 to 14";
  EXPECT_DOUBLE_EQ(Coverage(ThreeClips(), {}, 1).Of(0, 2).in_between_share, 1);
}

}  // namespace
}  // namespace etude
