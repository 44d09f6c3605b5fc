#include "sim/performer/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

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

}  // namespace
}  // namespace etude
