#include "engine/transitions/joins/splice.h"

#include <gtest/gtest.h>

#include "engine/motion/body.h"
#include "tests/engine/transitions/joins/join_pictures.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

const JoinKind& Cut() { return *FindJoin("cut"); }
const JoinKind& Spring() { return *FindJoin("inertialised-spring"); }

TEST(SpliceSegments, ReproducesAClipThatIsJoinedToItself) {
  const BodyMotion clip = WavingClip(60);
  BodyMotion elsewhere = clip;
  for (BodyPose& pose : elsewhere.poses) pose = FloorMove{.yaw = 1, .x = 2, .z = 3}.Apply(pose);
  const BodyMotion clips[] = {clip, elsewhere};
  for (const JoinKind& join : AllJoins()) {
    if (join.name == "dead-blending") continue;  // continues by extrapolation (choices/transition_test.cc)
    const Splice splice = SpliceSegments(clips, Segments(19, 19, clip), join);
    ASSERT_EQ(splice.motion.poses.size(), clip.poses.size());
    for (std::size_t f = 0; f < clip.poses.size(); ++f) ExpectSamePose(splice.motion.poses[f], clip.poses[f], 1e-9);
  }
}

TEST(SpliceSegments, PlaysTheOldClipToTheTransitionPointAndTheNewOneAfterIt) {
  const BodyMotion clips[] = {WavingClip(40), WavingClip(30, 2)};
  const Splice splice = SpliceSegments(clips, Segments(19, 5, clips[1]), Cut());
  ASSERT_EQ(splice.motion.poses.size(), 20u + 24u);
  ASSERT_EQ(splice.points.size(), 1u);
  EXPECT_EQ(splice.points[0].frame, 19);
  for (int f = 0; f < 20; ++f) ExpectSamePose(splice.motion.poses[f], clips[0].poses[f], 0);
  for (int f = 20; f < 44; ++f) EXPECT_NEAR(PoseGap(splice.motion.poses[f], clips[1].poses[f - 14]), 0, 1e-9);
  ExpectSamePose(splice.points[0].arriving_after, splice.motion.poses[20], 0);
  EXPECT_NEAR(Heading(splice.points[0].arriving), Heading(splice.points[0].leaving), 1e-12);
}

TEST(SpliceSegments, JoinsOntoWhatAnUnfinishedJoinShows) {
  const BodyMotion clips[] = {WavingClip(40), WavingClip(60, 5), WavingClip(60, 2)};
  const std::vector<Segment> hasty = {{.clip = 0, .first = 0, .last = 19, .own = {}},
                                      {.clip = 1, .first = 5, .last = 8, .own = {}},
                                      {.clip = 2, .first = 5, .last = 59, .own = {}}};
  const auto jump_at_second_point = [&](const JoinKind& join) {
    return JumpAt(SpliceSegments(clips, hasty, join).motion, 22);
  };
  EXPECT_GT(jump_at_second_point(Cut()), 0.3) << "the control";
  for (const JoinKind& join : AllJoins().subspan(1)) EXPECT_LT(jump_at_second_point(join), 0.12) << join.name;
}

TEST(SpliceSegments, TakesAClipAsMovingBeforeItsFirstFrame) {
  const BodyMotion clips[] = {WavingClip(40), WavingClip(40)};
  const Splice splice = SpliceSegments(clips, Segments(0, 0, clips[1]), Spring());
  for (int f = 0; f < 40; ++f) ExpectSamePose(splice.motion.poses[f], clips[0].poses[f], 1e-9);
}

TEST(SpliceSegments, PassesThroughAnInBetween) {
  const BodyMotion clips[] = {WavingClip(40), WavingClip(30, 2), WavingClip(50, 4)};
  const std::vector<Segment> way = {{.clip = 0, .first = 0, .last = 10, .own = {}},
                                    {.clip = 2, .first = 5, .last = 25, .own = {}},
                                    {.clip = 1, .first = 3, .last = 29, .own = {}}};
  const Splice splice = SpliceSegments(clips, way, Cut());
  ASSERT_EQ(splice.points.size(), 2u);
  EXPECT_EQ(splice.points[0].frame, 10);
  EXPECT_EQ(splice.points[1].frame, 10 + 20);
  EXPECT_EQ(splice.motion.poses.size(), 11u + 20u + 26u);
  EXPECT_NEAR(PoseGap(splice.motion.poses.back(), clips[1].poses.back()), 0, 1e-9);

  const Splice smooth = SpliceSegments(clips, way, Spring());
  for (int i : {0, 1}) {  // the choice of frames decides the gap, not the join
    ExpectSamePose(smooth.points[i].leaving, splice.points[i].leaving, 0);
    ExpectSamePose(smooth.points[i].arriving, splice.points[i].arriving, 0);
  }
}

}  // namespace
}  // namespace etude
