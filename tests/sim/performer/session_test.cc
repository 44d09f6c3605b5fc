#include "sim/performer/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/sim/performer/all_moves.h"

namespace etude {
namespace {

Performance PerformTrial(int trial, const SessionOptions& options) {
  const WorldKey key{7, "session-test", trial};
  RandomStream script(key, "plan"), dance(key, "performer");
  const Person person = DrawPerson(key, options.people);
  return Perform(dance, AllMoves(), person, PlanSession(script, AllMoves(), person, options));
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
    EXPECT_EQ(std::ranges::count_if(performance.events, [](const SessionEvent& e) { return !e.faults.empty(); }),
              faults);
  }
}

TEST(Session, AsksEveryMoveBeforeAnyComesAgain) {
  const Performance performance = PerformTrial(1, {.events = static_cast<int>(AllMoves().size())});
  std::set<std::string> asked;
  for (const SessionEvent& event : performance.events) asked.insert(event.move);
  EXPECT_EQ(asked.size(), AllMoves().size());
}

TEST(Session, IsTheSameEveryTimeAndAnotherForAnotherTrial) {
  const Performance a = PerformTrial(5, {}), b = PerformTrial(5, {}), c = PerformTrial(6, {});
  ASSERT_EQ(a.motion.poses.size(), b.motion.poses.size());
  for (std::size_t i = 0; i < a.motion.poses.size(); ++i) {
    ASSERT_EQ(a.motion.poses[i].joints, b.motion.poses[i].joints);
  }
  EXPECT_NE(a.motion.poses[40].joints, c.motion.poses[40].joints);
}

TEST(Session, IsSmoothFromTheFirstFrameToTheLast) {
  for (int trial = 0; trial < 6; ++trial) {
    const auto& poses = PerformTrial(trial, {.events = 11, .fault_share = 0.7}).motion.poses;
    double worst_jump = 0;
    for (std::size_t i = 2; i < poses.size(); ++i) {
      for (std::size_t j = 0; j < kRoleCount; ++j) {
        const glm::dvec3 bend = poses[i].joints[j] - 2.0 * poses[i - 1].joints[j] + poses[i - 2].joints[j];
        worst_jump = std::max(worst_jump, glm::length(bend));
      }
    }
    // The sharpest corner within moves (a clapping hand) is 8 cm; a cut between moves would be 50 cm.
    EXPECT_LT(worst_jump, 0.2) << trial;
  }
}

TEST(Session, WhoIsAbsentStandsAndIsNeverRight) {
  const Performance performance = PerformTrial(0, {.people = People::kAbsent, .events = 11});
  for (const BodyPose& pose : performance.motion.poses) {
    EXPECT_LT(pose[Role::kLeftHand].y, 1.1);
    EXPECT_LT(pose[Role::kRightHand].y, 1.1);
  }
  for (const SessionEvent& event : performance.events) {
    EXPECT_EQ(event.truth, Truth::kWrong) << event.move;
    EXPECT_EQ(event.danced, "");
    EXPECT_FALSE(event.first_right_s);
  }
}

TEST(Session, FaultsOfNoSeverityAreNoneAndFullOnesAreWrong) {
  for (const SessionEvent& event : PerformTrial(1, {.events = 22, .fault_share = 1, .severity = 0.0}).events) {
    EXPECT_FALSE(event.faults.empty());
    EXPECT_EQ(event.truth, Truth::kRight);
    ASSERT_TRUE(event.first_right_s);
    EXPECT_GT(*event.first_right_s, event.start_s);
    EXPECT_LT(*event.first_right_s, event.end_s);
  }
  int wrong = 0;
  for (const SessionEvent& event : PerformTrial(1, {.events = 22, .fault_share = 1, .severity = 1.0}).events) {
    EXPECT_NE(event.truth, Truth::kRight) << event.move << " " << FaultNames(event.faults);
    wrong += event.truth == Truth::kWrong;
  }
  EXPECT_GE(wrong, 18);
}

TEST(Session, OnlyTheFaultsAskedForHappen) {
  for (const SessionEvent& event : PerformTrial(2, {.events = 22, .fault_share = 1, .faults = {Fault::kLate}}).events) {
    ASSERT_EQ(event.faults.size(), 1u);
    EXPECT_EQ(event.faults.front().fault, Fault::kLate);
    EXPECT_EQ(event.deviation.limb_deg, 0);
  }
}

TEST(Session, SweepingSeverityChangesNoDice) {
  const Performance mild = PerformTrial(4, {.events = 11, .severity = 0.3}),
                    bad = PerformTrial(4, {.events = 11, .severity = 0.9});
  for (std::size_t i = 0; i < mild.events.size(); ++i) {
    EXPECT_EQ(FaultNames(mild.events[i].faults), FaultNames(bad.events[i].faults));
    EXPECT_EQ(mild.events[i].start_s, bad.events[i].start_s);
    EXPECT_LE(mild.events[i].deviation.limb_deg, bad.events[i].deviation.limb_deg + 1e-9);
  }
}

/// Returns the time (s) at which a hand is first at its greatest height within the event's window.
double TimeOfHighestHand(const Performance& performance, const SessionEvent& event) {
  std::size_t best = 0;
  double height = -1;
  for (auto i = static_cast<std::size_t>(event.start_s * 30); i < static_cast<std::size_t>(event.WindowEnd() * 30);
       ++i) {
    const BodyPose& pose = performance.motion.poses[i];
    const double y = std::max(pose[Role::kLeftHand].y, pose[Role::kRightHand].y);
    if (y > height) height = y, best = i;
  }
  return static_cast<double>(best) / 30;
}

TEST(Session, TheLastKeyBeatIsWhereTheMotionHasIt) {
  // The jump's last key beat is its top, with the hands highest.
  const Move& jump = *std::ranges::find(AllMoves(), "jump", &Move::name);
  for (int trial = 0; trial < 5; ++trial) {
    const WorldKey key{7, "key-beat", trial};
    RandomStream script(key, "plan"), dance(key, "dance");
    const Person person = DrawPerson(key, People::kExpert);
    const SessionPlan plan = PlanSession(script, {&jump, 1}, person, {.events = 2, .fault_share = 0});
    const Performance performance = Perform(dance, {&jump, 1}, person, plan);
    for (const SessionEvent& event : performance.events) {
      EXPECT_NEAR(TimeOfHighestHand(performance, event), event.first_right_s.value(), 0.12);
    }
  }
}

}  // namespace
}  // namespace etude
