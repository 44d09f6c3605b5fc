#include "engine/teaching/teach_move.h"

#include <gtest/gtest.h>

#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "tests/engine/teaching/arms.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::ArmsAt;
using testing::Raise;

TEST(TeachMove, FindsTheAnglesThatChangeAndTheirExtremes) {
  ASSERT_OK(move, TeachMove("raise", {Raise(10, 100)}));
  ASSERT_EQ(move->poses.size(), 2u);
  const double expected[] = {10, 100};
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_EQ(move->poses[k].targets.size(), 4u);  // only the arms, because the legs stand still
    for (const PoseTarget& target : move->poses[k].targets) {
      const bool is_elbow = target.feature == Feature::kRHE || target.feature == Feature::kLHE;
      EXPECT_NEAR(target.degrees, is_elbow ? 0 : expected[k], 4);
      EXPECT_EQ(target.tolerance_deg, TeachOptions{}.least_tolerance_deg);
    }
  }
  EXPECT_NEAR(move->span_s, 1.3 * 3, 1e-9);
}

TEST(TeachMove, TolerancesFollowTheSpreadOfExamplesWithinTheirBounds) {
  // Peaks of 90, 100 and 110 degrees have deviation 10, whatever the speeds.
  ASSERT_OK(move, TeachMove("raise", {Raise(10, 90, 1.5), Raise(10, 100, 2), Raise(10, 110, 3)}));
  ASSERT_EQ(move->poses.size(), 2u);
  EXPECT_NEAR(move->poses[1].targets[0].degrees, 99, 4);
  EXPECT_NEAR(move->poses[1].targets[0].tolerance_deg, 25, 4);
  EXPECT_EQ(move->poses[0].targets[0].tolerance_deg, TeachOptions{}.least_tolerance_deg);
  ASSERT_OK(wide, TeachMove("raise", {Raise(10, 60), Raise(10, 100), Raise(10, 160)}));
  EXPECT_EQ(wide->poses[1].targets[0].tolerance_deg, TeachOptions{}.most_tolerance_deg);
}

TEST(TeachMove, WhatWasTaughtIsFoundAgainAndALesserMoveIsNot) {
  ASSERT_OK(move, TeachMove("raise", {Raise(10, 100)}));
  const std::vector<TaughtMove> taught = {*move};
  ASSERT_OK(recogniser, MakeRecogniser({}, taught));
  const auto found = [&](const SkeletonStream& stream) {
    const SeenStream seen = SeeStream(stream, {});
    const auto trace = FollowStream(**recogniser, 1, seen, {});
    return FindMoves(*trace, stream.rate_hz, {}).size();
  };
  SkeletonStream twice = Raise(12, 95, 2.4);
  const SkeletonStream again = Raise(8, 108, 1.6);
  twice.frames.insert(twice.frames.end(), again.frames.begin(), again.frames.end());
  EXPECT_EQ(found(twice), 2u);
  EXPECT_EQ(found(Raise(10, 55)), 0u);
}

TEST(TeachMove, AMoveThatHardlyMovesIsTheArmsPose) {
  ASSERT_OK(move, TeachMove("stand", {Raise(40, 42)}));
  ASSERT_EQ(move->poses.size(), 1u);
  EXPECT_EQ(move->poses[0].targets.size(), 4u);
}

TEST(TeachMove, RefusesNothingToLearnFromAndWhatIsTooShortOrTooLong) {
  EXPECT_FALSE(TeachMove("x", {}));
  SkeletonStream nobody = Raise(10, 100);
  for (SensedFrame& frame : nobody.frames) frame.body_seen = false;
  EXPECT_NE(testing::Message(TeachMove("x", {nobody})).find("shows a body for only 0.00 s"), std::string::npos);
  EXPECT_NE(testing::Message(TeachMove("x", {Raise(10, 100, 70)})).find("lasts 71.0 s; allowed: at most 60 s"),
            std::string::npos);
}

}  // namespace
}  // namespace etude
