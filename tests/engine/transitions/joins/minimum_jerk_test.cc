#include "engine/transitions/joins/minimum_jerk.h"

#include <gtest/gtest.h>

#include "engine/transitions/joins/splice.h"
#include "tests/engine/transitions/expect_pose.h"
#include "tests/engine/transitions/joins/join_pictures.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

constexpr double kBlend_s = 0.6;
const Offset kOffset{.value = {0.4, -0.1, 0.2}, .velocity = {-1, 2, 0.5}};

glm::dvec3 At(double seconds) { return MinimumJerkDecay(kOffset, seconds, kBlend_s); }

/// By central differences of five points.
glm::dvec3 VelocityAt(double t) {
  constexpr double h = 1e-3;
  return (At(t - 2 * h) - 8.0 * At(t - h) + 8.0 * At(t + h) - At(t + 2 * h)) / (12 * h);
}
glm::dvec3 AccelerationAt(double t) {
  constexpr double h = 1e-3;
  return (-At(t - 2 * h) + 16.0 * At(t - h) - 30.0 * At(t) + 16.0 * At(t + h) - At(t + 2 * h)) / (12 * h * h);
}

TEST(MinimumJerkDecay, StartsWithTheOffsetAndItsWholeVelocityAndNoAcceleration) {
  EXPECT_LT(glm::distance(At(0), kOffset.value), 1e-15);
  EXPECT_LT(glm::distance(VelocityAt(0), kOffset.velocity), 1e-8);
  EXPECT_LT(glm::length(AccelerationAt(0)), 1e-6);
}

TEST(MinimumJerkDecay, EndsAtRestWithoutAcceleration) {
  EXPECT_EQ(At(kBlend_s), glm::dvec3(0));
  EXPECT_EQ(At(2 * kBlend_s), glm::dvec3(0));
  const double near = kBlend_s - 1e-4;  // the cubic root: all three go to zero
  EXPECT_LT(glm::length(At(near)), 1e-9);
  EXPECT_LT(glm::length(VelocityAt(kBlend_s - 0.004)), 0.01);
}

TEST(MinimumJerkDecay, FromRestIsFlashAndHogansMovement) {
  const Offset still{.value = {1, 0, 0}, .velocity = {0, 0, 0}};
  for (double s : {0.1, 0.25, 0.5, 0.9}) {
    EXPECT_NEAR(MinimumJerkDecay(still, s * 0.5, 0.5).x,
                1 - (10 * s * s * s - 15 * s * s * s * s + 6 * s * s * s * s * s), 1e-12);
  }
}

TEST(MinimumJerkDecay, KeepsWhatTurnsTheAxisAndWhatGrows) {
  const Offset turning{.value = {0.1, 0, 0}, .velocity = {0.5, 3, 0}};
  const glm::dvec3 soon = MinimumJerkDecay(turning, 0.05, 0.5);
  EXPECT_GT(soon.x, 0.1);
  EXPECT_GT(soon.y, 0.1);
}

class BothWays : public testing::TestWithParam<bool> {};

TEST_P(BothWays, ShowTheOldMotionsNextFrameFirstButForTheBlendsOwnBeginning) {
  const BodyMotion clips[] = {WavingClip(60), WavingClip(60, 2)};
  std::vector<Segment> way = Segments(19, 5, clips[1]);
  way.back().preferred = PreferredJoin{.blend_s = 1, .fades = GetParam()};
  const Splice splice = SpliceSegments(clips, way, *FindJoin("minimum-jerk"));
  for (Role role : AllRoles()) {
    // At s = 1/30 a share of 10 s³ of the gap, at most 1.7 m here.
    EXPECT_LT(glm::distance(splice.motion.poses[20][role], clips[0].poses[20][role]), 10 * 1.7 / 27000 + 1e-3)
        << RoleName(role);
  }
}

TEST_P(BothWays, EndInTheNewMotionWhenTheWishSays) {
  const BodyMotion clips[] = {WavingClip(60), WavingClip(60, 2)};
  std::vector<Segment> way = Segments(19, 5, clips[1]);
  way.back().preferred = PreferredJoin{.blend_s = 0.4, .fades = GetParam()};
  const Splice splice = SpliceSegments(clips, way, *FindJoin("minimum-jerk"));
  ExpectSamePose(splice.motion.poses[19 + 12], splice.wanted[12], 1e-9);
  EXPECT_GT(glm::distance(splice.motion.poses[19 + 6][Role::kLeftHand], splice.wanted[6][Role::kLeftHand]), 0.01);
}

INSTANTIATE_TEST_SUITE_P(MinimumJerk, BothWays, testing::Bool());

TEST(WindowOf, HoldsTheLastFrameOfAMotionThatEndsAndCountsTheRealOnes) {
  const BodyMotion clip = WavingClip(4);
  const JoinInput input{.shown = {clip.poses[0], clip.poses[1]},
                        .target = {clip.poses[0], clip.poses[1]},
                        .continuation = [&](std::size_t) { return std::vector<BodyPose>{clip.poses[2]}; },
                        .upcoming =
                            [&](std::size_t) {
                              return std::vector<BodyPose>{clip.poses[2], clip.poses[3]};
                            },
                        .preferred = {}};
  const JoinWindow window = WindowOf(input, 3);
  ASSERT_EQ(window.old.size(), 4u);
  ASSERT_EQ(window.next.size(), 4u);
  EXPECT_EQ(window.old_frames, 1);
  EXPECT_EQ(window.next_frames, 2);
  ExpectSamePose(window.old[3], clip.poses[2], 0);
  ExpectSamePose(window.next[3], clip.poses[3], 0);
}

}  // namespace
}  // namespace etude
