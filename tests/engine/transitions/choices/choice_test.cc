#include "engine/transitions/choices/choice.h"

#include <gtest/gtest.h>

#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

/// Clip 0 plays; clip 1 is unlike it; clip 2 leads from clip 0 to clip 1 in 20 frames.
MotionLibrary LibraryOfThree() {
  std::vector<double> levels(21);
  std::vector<int> frames(21);
  for (int f = 0; f <= 20; ++f) levels[f] = 0.05 + 0.1 * (frames[f] = f);
  MotionLibrary library;
  library.tagged = {ClipOfLevels({0, 0, 0, 0}, {1, 2}), ClipOfLevels({2, 2, 2, 2}, {1, 2}),
                    ClipOfLevels(levels, frames)};
  library.names = {"still", "raised", "between"};
  return library;
}

TransitionRecord Plan(std::string_view choice, const TransitionRequest& request) {
  return FindChoice(choice)->plan(LibraryOfThree(), request, {}, {});
}

TEST(FuzzyBridge, RecordsTheBranchItTook) {
  const TransitionRecord direct = Plan("fuzzy-bridge", {.from = 0, .request_frame = 0, .to = 2});
  EXPECT_EQ(direct.branch, Branch::kFrontHalf);
  EXPECT_NEAR(direct.wait_s, 1 / 30.0, 1e-12);
  EXPECT_EQ(Plan("fuzzy-bridge", {.from = 1, .request_frame = 0, .to = 2}).branch, Branch::kRearHalf);
}

TEST(FuzzyBridge, TellsOfThePairsItDidNotTake) {
  MotionLibrary library = LibraryOfThree();
  library.tagged[0] = ClipOfLevels({0, 0.3, 5, 0, 0}, {0, 1, 2, 3});
  const TransitionRecord record =
      FindChoice("fuzzy-bridge")->plan(library, {.from = 0, .request_frame = 0, .to = 2}, {}, {});
  // Clip 2 has the levels 0.05, 0.15, … 2.05. The first four match frames 0 and 3 (level 0, threshold 0.4), and the
  // first seven match frame 1 (level 0.3); none matches frame 2.
  EXPECT_EQ(record.pairs_seen, 4 * 20);
  EXPECT_EQ(record.pairs_matched, 4 + 7 + 4);
  ASSERT_EQ(record.candidates.size(), 5u) << "the taken pair, and the nearest other of each bridge frame";
  const auto expect = [&](std::size_t i, int from, int to, double distance, CandidateOutcome outcome) {
    const Candidate& candidate = record.candidates[i];
    EXPECT_EQ(candidate.from_frame, from);
    EXPECT_EQ(candidate.to_frame, to);
    EXPECT_NEAR(candidate.distance.value, distance, 1e-12);
    EXPECT_EQ(candidate.outcome, outcome);
  };
  expect(0, 0, 0, 0.05, CandidateOutcome::kTaken);
  expect(1, 0, 1, 0.15, CandidateOutcome::kLater);
  expect(2, 1, 2, 0.05, CandidateOutcome::kLater);
  expect(3, 2, 19, 3.05, CandidateOutcome::kTooFar);
  expect(4, 3, 0, 0.05, CandidateOutcome::kLater);
  EXPECT_EQ(record.why,
            "the first match: still frame 0 (0.00 s after the request) and between frame 0, with the distance d = 0.05 "
            "< 0.4; 15 pairs match, and 1 of them have a smaller distance but come later");
}

TEST(FuzzyBridge, TakesTheSmallestDistanceWhenToldTo) {
  MotionLibrary library = LibraryOfThree();
  library.tagged[0] = ClipOfLevels({0.4, 0.06, 0.05, 0}, {0, 1, 2});
  const TransitionRecord record =
      FindChoice("fuzzy-bridge")
          ->plan(library, {.from = 0, .request_frame = 0, .to = 2}, {.pick = Pick::kSmallest}, {});
  EXPECT_EQ(record.segments[0].last, 2);
  EXPECT_EQ(record.segments[1].first, 0);
  for (const Candidate& candidate : record.candidates) {
    EXPECT_TRUE(candidate.outcome == CandidateOutcome::kTaken || candidate.outcome == CandidateOutcome::kWorse);
  }
}

TEST(FuzzyBridge, SaysHowNearTheNearestWasWhenNoneMatches) {
  const TransitionRecord record = Plan("fuzzy-bridge", {.from = 0, .request_frame = 0, .to = 1});
  EXPECT_TRUE(record.segments.empty());
  EXPECT_EQ(record.why,
            "no match among 4 pairs of bridge frames: the smallest distance is d = 2.00, which is not below 0.4; and "
            "the library has no in-between clip");
}

TEST(AbruptChoices, GoToTheFirstFrameNowOrAtTheEnd) {
  const TransitionRecord now = Plan("now", {.from = 2, .request_frame = 8, .to = 1});
  ASSERT_EQ(now.segments.size(), 2u);
  EXPECT_EQ(now.segments[0].last, 8);
  EXPECT_EQ(now.segments[1].first, 0);
  EXPECT_EQ(now.wait_s, 0);
  EXPECT_NEAR(now.distances[0].value, 2 - 0.85, 1e-12);
  EXPECT_EQ(now.why, "the transition goes at once into the first frame, whatever the poses are; d = 1.15");

  const TransitionRecord end = Plan("wait-for-end", {.from = 2, .request_frame = 8, .to = 1});
  EXPECT_EQ(end.segments[0].last, 20);
  EXPECT_NEAR(end.wait_s, 12 / 30.0, 1e-12);
  EXPECT_EQ(end.why, "the playing clip ended after 0.40 s; the distance to the first frame is d = 0.05");
}

}  // namespace
}  // namespace etude
