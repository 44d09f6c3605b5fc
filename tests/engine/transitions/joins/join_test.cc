#include "engine/transitions/joins/join.h"

#include <gtest/gtest.h>

#include "tests/engine/transitions/joins/join_pictures.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

const std::vector<BodyMotion>& Strangers() {
  static const std::vector<BodyMotion> kClips = {WavingClip(40), WavingClip(120, 5)};
  return kClips;
}

BodyMotion Spliced(const JoinKind& join) {
  return SpliceSegments(Strangers(), Segments(19, 5, Strangers()[1]), join).motion;
}

BodyMotion CutTogether() { return Spliced(AllJoins().front()); }

class EverySmoothJoin : public ::testing::TestWithParam<std::string> {
 protected:
  const JoinKind& TheJoin() const { return *FindJoin(GetParam()); }
};

TEST_P(EverySmoothJoin, TakesTheJumpAwayAndKeepsTheLimbs) {
  const BodyMotion cut = CutTogether(), smooth = Spliced(TheJoin());
  EXPECT_GT(JumpAt(cut, 19), 0.3) << "the control: these clips do not fit";
  EXPECT_LT(std::max(JumpAt(smooth, 19), JumpAt(smooth, 20)), 0.2 * JumpAt(cut, 19));
  ExpectSameLimbs(smooth, Strangers()[0].poses[0]);
}

TEST_P(EverySmoothJoin, LeavesWhatWasShownAndEndsInTheNewMotion) {
  const BodyMotion cut = CutTogether(), smooth = Spliced(TheJoin());
  ASSERT_EQ(smooth.poses.size(), cut.poses.size());
  for (int f = 0; f <= 19; ++f) ExpectSamePose(smooth.poses[f], cut.poses[f], 0);
  ExpectSamePose(smooth.poses.back(), cut.poses.back(), 1e-9);
}

TEST_P(EverySmoothJoin, TurnsOppositeLimbsAroundWithoutBreakingThem) {
  const std::vector<BodyMotion> clips = {StandingClip(10, 0), StandingClip(90, 180)};
  const BodyMotion motion = SpliceSegments(clips, Segments(5, 0, clips[1]), TheJoin()).motion;
  ExpectSameLimbs(motion, clips[0].poses[0]);
  ExpectSamePose(motion.poses.back(), clips[1].poses.back(), 1e-6);
  const double arm = glm::distance(motion.poses[6][Role::kLeftHand], motion.poses[5][Role::kLeftHand]);
  EXPECT_GT(arm, 0) << "it is on its way";
  EXPECT_LT(arm, 0.3) << "and has not jumped there";
}

INSTANTIATE_TEST_SUITE_P(All, EverySmoothJoin,
                         ::testing::Values("crossfade", "inertialised-quintic", "inertialised-spring", "dead-blending",
                                           "minimum-jerk", "planted-feet"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Joins, AreAllTestedHere) { EXPECT_EQ(AllJoins().size(), 1 + 6u); }

TEST(Joins, WithABlendEndExactlyInTheNewMotionAfterIt) {
  const BodyMotion cut = CutTogether();
  for (const char* name : {"crossfade", "inertialised-quintic", "dead-blending"}) {
    const Splice splice =
        SpliceSegments(Strangers(), Segments(19, 5, Strangers()[1]), *FindJoin(name), std::vector{0.5});
    ExpectSamePose(splice.motion.poses[19 + 15], cut.poses[19 + 15], 1e-9);
    EXPECT_GT(glm::distance(splice.motion.poses[19 + 8][Role::kLeftHand], cut.poses[19 + 8][Role::kLeftHand]), 0.01)
        << name << ": half a second, no sooner";
  }
}

}  // namespace
}  // namespace etude
