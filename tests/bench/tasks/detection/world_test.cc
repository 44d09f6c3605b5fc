#include "bench/tasks/detection/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/bench/tasks/detection/detection_fixture.h"

namespace etude {
namespace {

class DetectionWorldTest : public DetectionFixture {
 protected:
  static DetectionWorld Make(const SessionOptions& session, int trial) {
    return MakeDetectionWorld(RepertoireOf(FourMoves()), {.session = session}, World(trial));
  }
  static double HeadHeight(const DetectionWorld& world) {
    return world.motion.poses.front().joints[Index(Role::kHead)].y;
  }
};

TEST_F(DetectionWorldTest, EveryTrialHasAPersonOfItsOwn) {
  std::set<double> heights;
  for (int trial = 0; trial < 8; ++trial) heights.insert(HeadHeight(Make({.events = 2}, trial)));
  EXPECT_EQ(heights.size(), 8u);
}

TEST_F(DetectionWorldTest, SweepingPeopleAsksForTheSameMovesAndFaults) {
  const DetectionWorld toddler = Make({.people = People::kToddler, .events = 8}, 3),
                       expert = Make({.people = People::kExpert, .events = 8}, 3);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(toddler.events[i].move, expert.events[i].move);
    EXPECT_EQ(FaultNames(toddler.events[i].faults), FaultNames(expert.events[i].faults));
  }
  EXPECT_LT(HeadHeight(toddler), 1.2);
  EXPECT_GT(HeadHeight(expert), 1.2);
}

TEST_F(DetectionWorldTest, WorseFaultsLeaveFewerRight) {
  const auto right = [&](double severity) {
    int count = 0;
    for (int trial = 0; trial < 2; ++trial) {
      const DetectionWorld world = Make({.events = 8, .fault_share = 1, .severity = severity}, trial);
      for (const DetectionEvent& event : world.events) count += event.IsRight();
    }
    return count;
  };
  EXPECT_EQ(right(0), 16);
  EXPECT_LT(right(0.3), 16);
  EXPECT_LT(right(0.6), right(0.3));
  EXPECT_EQ(right(1), 0);
}

}  // namespace
}  // namespace etude
