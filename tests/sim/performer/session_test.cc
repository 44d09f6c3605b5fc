#include "sim/performer/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/performer/faults.h"

namespace etude {
namespace {

const std::vector<Move>& AllMoves() {
  static const std::vector<Move> moves = [] {
    std::vector<Move> loaded;
    for (const std::string& name : BuiltinMoveNames()) loaded.push_back(LoadBuiltinMove(name).value());
    return loaded;
  }();
  return moves;
}

Performance PerformTrial(int trial, const SessionOptions& options) {
  const WorldKey key{7, "session-test", trial};
  RandomStream script(key, "plan"), learner(key, "performer");
  return Perform(learner, AllMoves(), PlanSession(script, AllMoves(), options), options);
}

TEST(Session, RightEventsReachTheirKeyPosesAndFaultsNeverDo) {
  int right = 0;
  std::set<Fault> seen;
  for (int trial = 0; trial < 2; ++trial) {
    for (double skill : {0.0, 1.0}) {
      for (const SessionEvent& event : PerformTrial(trial, {.events = 22, .skill = skill}).events) {
        EXPECT_EQ(event.first_right_s.has_value(), event.IsRight())
            << event.move << " " << FaultName(event.fault) << " " << event.danced << " trial " << trial;
        if (event.first_right_s) {
          EXPECT_GE(*event.first_right_s, event.start_s);
          EXPECT_LE(*event.first_right_s, event.WindowEnd());
        }
        right += event.IsRight();
        seen.insert(event.fault);
      }
    }
  }
  EXPECT_EQ(right, 2 * 2 * 11);
  EXPECT_EQ(seen.size(), 5u) << "every kind of fault must have come up";
}

TEST(Session, WindowsNeverOverlapAndFitTheMotion) {
  const Performance performance = PerformTrial(0, {.events = 12, .rest_s = 1});
  double end = 0;
  for (const SessionEvent& event : performance.events) {
    EXPECT_GE(event.start_s, end + 1);
    EXPECT_GT(event.end_s, event.start_s);
    end = event.WindowEnd();
  }
  EXPECT_GE(performance.motion.DurationSeconds(), end);
}

TEST(Session, HasTheShareOfFaultsAskedFor) {
  for (const auto& [share, faults] : {std::pair(0.0, 0), {0.25, 3}, {1.0, 12}}) {
    const Performance performance = PerformTrial(3, {.events = 12, .fault_share = share});
    EXPECT_EQ(std::ranges::count_if(performance.events, [](const SessionEvent& e) { return !e.IsRight(); }), faults);
  }
}

TEST(Session, AsksEveryMoveBeforeAnyComesAgain) {
  const Performance performance = PerformTrial(1, {.events = static_cast<int>(AllMoves().size())});
  std::set<std::string> asked;
  for (const SessionEvent& event : performance.events) asked.insert(event.move);
  EXPECT_EQ(asked.size(), AllMoves().size());
}

TEST(Session, IsSmoothFromTheFirstFrameToTheLast) {
  const Performance performance = PerformTrial(2, {.events = 11});
  const auto& poses = performance.motion.poses;
  double worst_jump = 0;
  for (std::size_t i = 2; i < poses.size(); ++i) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const glm::dvec3 bend = poses[i].joints[j] - 2.0 * poses[i - 1].joints[j] + poses[i - 2].joints[j];
      worst_jump = std::max(worst_jump, glm::length(bend));
    }
  }
  // The moves' own sharpest corner (a clapping hand) is 8 cm; a cut between moves would be 50.
  EXPECT_LT(worst_jump, 0.12);
}

TEST(Session, IsTheSameEveryTimeAndAnotherForAnotherTrial) {
  const Performance a = PerformTrial(5, {}), b = PerformTrial(5, {}), c = PerformTrial(6, {});
  ASSERT_EQ(a.motion.poses.size(), b.motion.poses.size());
  for (std::size_t i = 0; i < a.motion.poses.size(); ++i) {
    ASSERT_EQ(a.motion.poses[i].joints, b.motion.poses[i].joints);
  }
  EXPECT_NE(a.motion.poses[40].joints, c.motion.poses[40].joints);
}

TEST(Session, StandsWhenAMoveIsSkipped) {
  SessionEvent skipped;
  skipped.move = "clap";
  skipped.fault = Fault::kSkipped;
  skipped.start_s = 2;
  skipped.end_s = 4;
  RandomStream learner({}, "performer");
  const Performance performance = Perform(learner, AllMoves(), {.events = {skipped}, .duration_s = 6}, {});
  for (const BodyPose& pose : performance.motion.poses) {
    EXPECT_LT(pose[Role::kLeftHand].y, 1.0);
    EXPECT_LT(pose[Role::kRightHand].y, 1.0);
  }
}

TEST(Faults, OnlyOneSidedMovesCanBeDancedOnTheWrongSide) {
  const auto can = [](const std::string& name, Fault fault) {
    const auto faults = ShowableFaults(LoadBuiltinMove(name).value(), AllMoves());
    return std::ranges::find(faults, fault) != faults.end();
  };
  EXPECT_TRUE(can("side_kick", Fault::kWrongSide));
  EXPECT_TRUE(can("side_stretch", Fault::kWrongSide));
  EXPECT_FALSE(can("boxing", Fault::kWrongSide));
  EXPECT_FALSE(can("clap", Fault::kWrongSide));
  for (const Move& move : AllMoves()) EXPECT_TRUE(can(move.name, Fault::kHalfAmplitude)) << move.name;
}

TEST(Faults, AMoveWithoutOthersCannotBeMistaken) {
  const Move clap = LoadBuiltinMove("clap").value();
  EXPECT_TRUE(WrongMoves(clap, {&clap, 1}).empty());
  EXPECT_FALSE(WrongMoves(clap, AllMoves()).empty());
}

}  // namespace
}  // namespace etude
