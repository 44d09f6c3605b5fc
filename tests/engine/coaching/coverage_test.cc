// Paper A, section 3.5: every move needs a bridge frame into the corrective clips.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/transitions/library/library.h"
#include "engine/transitions/library/coverage.h"
#include "sim/choreography/move.h"

namespace etude {
namespace {

/// Returns the moves without a bridge frame into `wanted`, in a library of all moves and `wanted`.
std::vector<std::string> MovesWithoutWayInto(const std::string& wanted) {
  std::vector<std::string> names = BuiltinMoveNames();
  const auto moves = static_cast<int>(names.size());
  names.push_back(wanted);
  std::vector<BodyMotion> clips;
  for (const std::string& name : names) {
    const auto move = LoadBuiltinMove(name);
    EXPECT_TRUE(move) << ToString(move.error());
    if (!move) return {};
    clips.push_back(move->motion);
  }
  constexpr double kHipHeight = 0.9;  // the height at which `etude bridge` measures
  const MotionLibrary library = MakeLibrary(names, clips, MakeBodyProportions(clips.front().poses.front(), kHipHeight));
  const Coverage coverage(library.tagged, {}, {.with_pairs = false, .wanted = {moves}});
  std::vector<std::string> without;
  for (int clip : coverage.WithoutWayInto(moves)) without.push_back(names[clip]);
  return without;
}

TEST(Coverage, EveryMoveReachesEveryCorrectiveAct) {
  for (const char* act : {"head_shake", "wave", "puzzled"}) {
    EXPECT_THAT(MovesWithoutWayInto(act), ::testing::IsEmpty()) << act;
  }
}

TEST(Coverage, EveryMoveReachesItsOwnSlowDemonstration) {
  for (const std::string& move : BuiltinMoveNames()) {
    EXPECT_THAT(MovesWithoutWayInto("slow_" + move), ::testing::Not(::testing::Contains(move)));
  }
}

TEST(Coverage, AnActForWaitingIsNotReachedByAll) {  // the control: moves without a way exist
  EXPECT_THAT(MovesWithoutWayInto("doze"), ::testing::Not(::testing::IsEmpty()));
}

}  // namespace
}  // namespace etude
