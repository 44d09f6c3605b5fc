#include "engine/transitions/library/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/transitions/library/transition_points.h"
#include "tests/engine/transitions/search/search_data.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Returns three clips. The first has 30 frames and the bridge frames 2, 10 and 14; its frames 10, 14 and 20 match
/// the second clip. The third clip matches nothing.
std::vector<TaggedClip> ThreeClips() {
  std::vector<double> levels(30, 5.0);
  levels[10] = levels[14] = levels[20] = 0;
  return {ClipOfLevels(levels, {2, 10, 14}), ClipOfLevels({0, 0, 0, 0}, {0, 1}), ClipOfLevels({9, 9, 9}, {0, 1})};
}

TEST(Coverage, NamesTheClipsWithoutAWay) {
  const Coverage coverage(ThreeClips(), {});
  EXPECT_THAT(coverage.WithoutWayInto(1), ElementsAre(2));
  EXPECT_THAT(coverage.WithoutWayInto(2), ElementsAre(0, 1));
  EXPECT_THAT(Coverage(ThreeClips(), {.threshold = 20}).WithoutWayInto(2), IsEmpty());
}

TEST(Coverage, SharesAreOfAllFramesAndOfBridgeFrames) {
  const Coverage coverage(ThreeClips(), {});
  EXPECT_DOUBLE_EQ(coverage.Of(0, 1).frame_share, 3.0 / 30);
  EXPECT_DOUBLE_EQ(coverage.Of(0, 1).bridge_share, 2.0 / 3);
  EXPECT_DOUBLE_EQ(coverage.Of(1, 0).bridge_share, 1.0);
  EXPECT_DOUBLE_EQ(coverage.Of(0, 2).bridge_share, 0.0);
}

TEST(Coverage, WaitsOverTheEndOfAClipThatStartsOver) {
  const Coverage coverage(ThreeClips(), {});
  ASSERT_TRUE(coverage.Of(0, 1).worst_wait_s);
  EXPECT_NEAR(*coverage.Of(0, 1).worst_wait_s, 25.0 / 30, 1e-12) << "from frame 15 over the end to frame 10";
  EXPECT_FALSE(coverage.Of(0, 2).worst_wait_s);
}

TEST(Coverage, NeedsAnInBetweenWhereNoMatchComesWithinTheBudget) {
  EXPECT_DOUBLE_EQ(Coverage(ThreeClips(), {}).Of(0, 1).in_between_share, 15.0 / 30) << "frames 15 to 29";
  EXPECT_DOUBLE_EQ(Coverage(ThreeClips(), {}, {.budget_s = 0.1}).Of(0, 1).in_between_share, 22.0 / 30)
      << "three frames of waiting: only from 7 to 14";
  EXPECT_DOUBLE_EQ(Coverage(ThreeClips(), {}).Of(0, 2).in_between_share, 1);
}

TEST(Coverage, IntoAnyClipCountsAFrameOnceThatMatchesSeveral) {
  std::vector<TaggedClip> clips = ThreeClips();
  clips.push_back(clips[1]);
  const Coverage coverage(clips, {});
  EXPECT_DOUBLE_EQ(coverage.IntoAny(0).frame_share, 3.0 / 30);
  EXPECT_DOUBLE_EQ(coverage.IntoAny(0).bridge_share, 2.0 / 3);
  EXPECT_DOUBLE_EQ(coverage.IntoAny(0).in_between_share, 15.0 / 30);
  EXPECT_DOUBLE_EQ(coverage.IntoAny(1).frame_share, 1);
  EXPECT_DOUBLE_EQ(coverage.IntoAny(2).frame_share, 0);
  EXPECT_FALSE(coverage.IntoAny(2).worst_wait_s);
}

TEST(Coverage, WithoutPairsKnowsTheWaysIntoTheClipsThatAreWanted) {
  const Coverage coverage(ThreeClips(), {}, {.with_pairs = false, .wanted = {2}});
  EXPECT_FALSE(coverage.HasPairs());
  EXPECT_THAT(coverage.WithoutWayInto(2), ElementsAre(0, 1));
  EXPECT_DOUBLE_EQ(coverage.IntoAny(0).in_between_share, 15.0 / 30);
}

/// Returns clips of many lengths with some bridge frames each.
std::vector<TaggedClip> UnevenLibrary() {
  RandomStream dice = SearchDice("partners");
  std::vector<std::vector<Grades>> all;
  for (int count : {200, 1, 2, 47, 0, 90, 260}) all.push_back(WanderingFrames(count, dice));
  // A clip repeats another one's frames backwards, so that equal distances occur far apart in time.
  all.push_back(all[0]);
  all.back().insert(all.back().end(), all[0].rbegin(), all[0].rend());
  std::vector<TaggedClip> clips;
  for (std::vector<Grades>& grades : all) {
    TaggedClip& clip = clips.emplace_back();
    for (const Grades& frame : grades) clip.tags.push_back(ChooseTags(frame));
    clip.grades = std::move(grades);
    const int every = static_cast<int>(clips.size());
    for (int f = 0; f < clip.FrameCount(); f += every) clip.bridge_frames.push_back(f);
  }
  return clips;
}

/// A second implementation: compares every frame with every frame.
bool HasMatchByLoop(const TaggedClip& from, int frame, const TaggedClip& to, std::span<const int> entering,
                    const MatchRules& rules) {
  return std::ranges::any_of(entering, [&](int other) {
    return EntryWindow(to).Contains(other) && Matches(from, frame, to, other, rules);
  });
}

TEST(Coverage, IsThatOfALoopForAnyRules) {
  const std::vector<TaggedClip> clips = UnevenLibrary();
  FeatureWeights two_features{};
  two_features[0] = two_features[7] = 4;
  int matching = 0, matching_none = 0;
  for (const double threshold : {-1.0, 0.0, 1e-160, kPaperThreshold, 1.5, kInfinity}) {
    for (const bool within_class : {false, true}) {
      for (const FeatureWeights& weights : {PaperWeights(), two_features}) {
        SCOPED_TRACE(::testing::Message() << threshold << (within_class ? " in class" : ""));
        const MatchRules rules{.weights = weights, .threshold = threshold, .within_class = within_class};
        const Coverage coverage(clips, rules);
        for (int a = 0; a < coverage.ClipCount(); ++a) {
          const TaggedClip& from = clips[a];
          std::vector<bool> leads(from.grades.size());
          for (int b = 0; b < coverage.ClipCount(); ++b) {
            if (a == b) continue;
            const std::vector<int> entering = FramesWithin(EntryWindow(clips[b]));
            std::size_t count = 0;
            for (int f = 0; f < from.FrameCount(); ++f) {
              if (!HasMatchByLoop(from, f, clips[b], entering, rules)) continue;
              leads[f] = true;
              ++count;
            }
            const double share = from.grades.empty() ? 0 : static_cast<double>(count) / from.FrameCount();
            EXPECT_EQ(coverage.Of(a, b).frame_share, share);
            std::size_t bridges = 0;
            for (int f : from.bridge_frames) {
              bridges += HasMatchByLoop(from, f, clips[b], clips[b].bridge_frames, rules) ? 1 : 0;
            }
            const double all = static_cast<double>(from.bridge_frames.size());
            EXPECT_EQ(coverage.Of(a, b).bridge_share, all == 0 ? 0 : static_cast<double>(bridges) / all);
          }
          const auto found = static_cast<int>(std::ranges::count(leads, true));
          EXPECT_EQ(coverage.IntoAny(a).frame_share, leads.empty() ? 0 : static_cast<double>(found) / from.FrameCount());
          matching += found;
          matching_none += from.FrameCount() - found;
        }
      }
    }
  }
  EXPECT_GT(matching, 1000);
  EXPECT_GT(matching_none, 1000);
}

}  // namespace
}  // namespace etude
