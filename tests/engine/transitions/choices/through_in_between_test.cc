#include "engine/transitions/choices/through_in_between.h"

#include <gtest/gtest.h>

#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/library/library.h"
#include "tests/engine/transitions/connection.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

/// Clips of arms that stay down, wave, and stay up; the first has nothing in common with the last.
MotionLibrary SmallLibrary(const TagRules& rules = {}) {
  const BodyMotion clips[] = {StandingClip(60, 0), WavingClip(80), WavingClip(70, 1.5), StandingClip(40, 150)};
  return MakeLibrary({"down", "wave", "wave too", "up"}, clips, MakeBodyProportions(StandingClip(1, 0).poses[0], 0.9),
                     rules);
}

double DistanceToKey(const MotionLibrary& library, const InBetweenNet& net, int clip, int frame) {
  double nearest = 1e9;
  for (const InBetweenNet::Key& key : net.keys) {
    nearest = std::min(nearest, ComputeDistance(library.tagged[clip].grades[frame],
                                                library.tagged[key.clip].grades[key.frame], PaperWeights())
                                    .value);
  }
  return nearest;
}

/// Returns the number of bridge frames without a key within the threshold.
int CountUncovered(const MotionLibrary& library, const InBetweenNet& net) {
  int uncovered = 0;
  for (int clip = 0; clip < static_cast<int>(library.tagged.size()); ++clip) {
    for (int frame : library.tagged[clip].bridge_frames) {
      uncovered += DistanceToKey(library, net, clip, frame) >= kPaperThreshold;
    }
  }
  return uncovered;
}

TransitionRecord Take(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules = {}) {
  TransitionRecord record = ThroughInBetween(library, request, rules, "no direct way", 0);
  EXPECT_FALSE(record.segments.empty());
  return record;
}

TEST(InBetweenKeys, CoverEveryBridgeFrame) {
  const MotionLibrary library = BuiltinLibrary();
  EXPECT_EQ(CountUncovered(library, library.in_betweens), 0);
  InBetweenNet without_hub = library.in_betweens;
  without_hub.keys.erase(without_hub.keys.begin());
  EXPECT_GT(CountUncovered(library, without_hub), 0) << "no key is idle, the first least of all";
}

TEST(InBetweenKeys, BeginWithTheMostFrequentPose) {
  const MotionLibrary library = SmallLibrary();
  const InBetweenNet::Key hub = library.in_betweens.keys.front();
  const auto ratings = RateFrames(library.tagged, PaperWeights());
  for (int clip = 0; clip < 4; ++clip) {
    for (int frame : library.tagged[clip].bridge_frames) {
      EXPECT_LE(ratings[clip][frame].clips, ratings[hub.clip][hub.frame].clips);
    }
  }
}

TEST(InBetweenKeys, OfALibraryWithoutBridgeFramesAreOfAllFrames) {
  TagRules rules;
  rules.min_clips = 5;
  const MotionLibrary library = SmallLibrary(rules);
  EXPECT_FALSE(library.in_betweens.keys.empty());
  EXPECT_EQ(Take(library, {.from = 0, .request_frame = 5, .to = 3}).branch, Branch::kForced);
}

TEST(InBetween, LeadsFromOneKeyPoseToAnother) {
  const MotionLibrary library = SmallLibrary();
  const TransitionRecord record = Take(library, {.from = 0, .request_frame = 5, .to = 3});
  EXPECT_EQ(record.branch, Branch::kInBetween);
  ASSERT_EQ(record.segments.size(), 3u);
  EXPECT_EQ(record.segments[0].last, 5) << "the very first frame is a bridge frame";
  EXPECT_EQ(record.segments[1].clip, Segment::kOwnFrames);
  EXPECT_EQ(record.segments[1].last + 1, static_cast<int>(record.segments[1].own.size()));
  EXPECT_LT(record.segments[2].first, 20) << "the front half";
  ASSERT_EQ(record.distances.size(), 2u);
  const auto grades = [](const BodyPose& pose) { return Fuzzify(ComputeFeatures(pose, 0.9)); };
  const auto distance = [](const Grades& a, const Grades& b) { return ComputeDistance(a, b, PaperWeights()).value; };
  const double leaving = distance(library.tagged[0].grades[5], grades(record.segments[1].own.front()));
  const double entering =
      distance(grades(record.segments[1].own.back()), library.tagged[3].grades[record.segments[2].first]);
  EXPECT_NEAR(record.distances[0].value, leaving, 1e-9);
  EXPECT_NEAR(record.distances[1].value, entering, 1e-6);
  EXPECT_LT(std::max(leaving, entering), kPaperThreshold);
  EXPECT_NEAR(record.wait_s, record.segments[1].last / 30.0, 1e-12);
  EXPECT_FALSE(record.why.empty());
}

TEST(InBetween, TellsWhatItTookAtBothEnds) {
  const MotionLibrary library = SmallLibrary();
  const TransitionRecord record = Take(library, {.from = 1, .request_frame = 20, .to = 3});
  int taken = 0;
  for (const Candidate& candidate : record.candidates) {
    taken += candidate.outcome == CandidateOutcome::kTaken;
    const Segment &left = record.segments.at(candidate.point), &entered = record.segments.at(candidate.point + 1);
    EXPECT_TRUE(left.last == candidate.from_frame || entered.first == candidate.to_frame) << candidate.point;
  }
  EXPECT_EQ(taken, 2);
  EXPECT_LE(record.candidates.size(), kMaxCandidates);
  EXPECT_GE(record.pairs_seen, record.pairs_matched);
  EXPECT_GE(record.pairs_matched, 2);
}

TEST(InBetween, NeverSaysOfAFrameOfAnotherClassThatItMatches) {
  MotionLibrary library = SmallLibrary();
  const TransitionRequest request{.from = 1, .request_frame = 20, .to = 2};
  int later = 0, later_of_other_class = 0;
  MatchRules rules;
  rules.within_class = true;
  for (const bool within_class : {false, true}) {
    rules.within_class = within_class;
    const TransitionRecord record = Take(library, request, rules);
    for (const Candidate& candidate : record.candidates) {
      if (candidate.to_frame != 0 || candidate.outcome != CandidateOutcome::kLater) continue;
      const bool same = library.tagged[1].tags[candidate.from_frame] == library.tagged[1].tags[record.segments[0].last];
      (within_class ? later_of_other_class : later) += within_class ? !same : 1;
    }
  }
  EXPECT_GT(later, 0);
  EXPECT_EQ(later_of_other_class, 0);
}

TEST(InBetween, IsForcedWhereTheWindowHasNoBridgeFrame) {
  MotionLibrary library = SmallLibrary();
  library.tagged[1].bridge_frames = {70};
  const TransitionRecord record = Take(library, {.from = 1, .request_frame = 10, .to = 3});
  EXPECT_EQ(record.branch, Branch::kForced);
  EXPECT_GE(record.segments[0].last, 10);
  EXPECT_LE(record.segments[0].last, 40);
  double nearest = 1e9;
  for (int frame = 10; frame <= 40; ++frame) {
    nearest = std::min(nearest, DistanceToKey(library, library.in_betweens, 1, frame));
  }
  EXPECT_EQ(record.distances[0].value, nearest) << "left where a key is nearest";
}

TEST(InBetween, GoesByTheHubWhenALimbWouldTurnTooFar) {
  MotionLibrary library = SmallLibrary();
  const auto frames = [&] { return Take(library, {.from = 0, .request_frame = 5, .to = 3}).segments[1].own.size(); };
  library.in_betweens.keys.insert(library.in_betweens.keys.begin(), {1, 0});  // a key with the arms at 80 degrees
  const std::size_t by_hub = frames();
  library.in_betweens.tween.widest_turn = kPi;
  EXPECT_GT(by_hub, frames());
}

TEST(InBetween, NeedsKeys) {
  MotionLibrary library = SmallLibrary();
  library.in_betweens.keys.clear();
  const TransitionRecord record =
      ThroughInBetween(library, {.from = 0, .request_frame = 0, .to = 1}, {}, "no match", 7);
  EXPECT_TRUE(record.segments.empty());
  EXPECT_EQ(record.branch, Branch::kNone);
  EXPECT_EQ(record.pairs_seen, 7);
  EXPECT_EQ(record.why, "no match; and the library has no in-between clip");
}

TEST(InBetween, ConnectsTheBuiltInClipsInBoundedTime) {
  const MotionLibrary library = BuiltinLibrary();
  const double bound = 1 + LongestInBetween(library.in_betweens.tween, kJudgedRateHz);
  const Connections connections = TryAll(library, 40);
  EXPECT_EQ(connections.found, connections.tried);
  EXPECT_GT(connections.tried, 1000);
  EXPECT_LE(connections.worst_wait_s, bound);
  EXPECT_GT(connections.worst_wait_s, bound / 2) << "a bound that means something";
}

}  // namespace
}  // namespace etude
