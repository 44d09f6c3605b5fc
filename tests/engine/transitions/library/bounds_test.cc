#include <gtest/gtest.h>

#include "engine/transitions/library/transition_points.h"
#include "tests/engine/transitions/random_clips.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

TEST(WindowsAndHeads, EndAtTheirLimits) {
  const TaggedClip clip = ClipOfLevels(std::vector<double>(20, 0.0), {0, 4, 9, 18, 19});
  EXPECT_EQ(FramesWithin({3, 6}), (std::vector{3, 4, 5, 6}));
  EXPECT_EQ(FramesWithin({3, 3}), std::vector{3});
  EXPECT_TRUE(FramesWithin({3, 2}).empty() && FramesWithin({3, 0}).empty());
  EXPECT_EQ(BridgeFramesWithin(clip, {4, 18}), (std::vector{4, 9, 18}));
  EXPECT_EQ(BridgeFramesWithin(clip, EntryWindow(clip)), (std::vector{0, 4, 9, 18}));
  const HeadRule still{.max_bend = 0, .max_turn_speed = 0};
  EXPECT_EQ(FindQuietHeads(StandingClip(2, 30), still), std::vector<bool>(2, true)) << "at its limits it is quiet";
}

TEST(Stance, IsDownAndNeedsAClipFromItsLimitsOn) {
  EXPECT_TRUE(StanceOf(PosedBody().Pose(), 0.84 / 0.6 + 1e-9).hips <= 0.84);
  EXPECT_FALSE(NeedsClip({.is_down = true, .hips = 0.5}, {.is_down = false, .hips = 0.75 - 0.05}));
  EXPECT_TRUE(NeedsClip({.is_down = true, .hips = 0.5}, {.is_down = false, .hips = 0.75 - 0.0499}));
}

}  // namespace
}  // namespace etude
