#include "engine/transitions/joins/minimum_jerk.h"

#include <gtest/gtest.h>

#include "engine/transitions/joins/splice.h"
#include "tests/engine/transitions/expect_pose.h"
#include "tests/engine/transitions/joins/join_pictures.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

constexpr double kBlend_s = 0.6;
const Movement kMovement{.start = {0.4, -0.1, 0.2}, .start_velocity = {-1, 2, 0.5}, .end_velocity = {0.3, -0.7, 1.5}};

glm::dvec3 At(double seconds) { return MinimumJerkAt(kMovement, seconds, kBlend_s); }

/// Differences over four points on one side: +h at the start, −h at the end.
glm::dvec3 VelocityAt(double t, double h) {
  return (-11.0 * At(t) + 18.0 * At(t + h) - 9.0 * At(t + 2 * h) + 2.0 * At(t + 3 * h)) / (6 * h);
}
glm::dvec3 AccelerationAt(double t, double h) {
  return (2.0 * At(t) - 5.0 * At(t + h) + 4.0 * At(t + 2 * h) - At(t + 3 * h)) / (h * h);
}

TEST(MinimumJerkAt, StartsWithItsVelocityAndNoAcceleration) {
  EXPECT_LT(glm::distance(At(0), kMovement.start), 1e-15);
  EXPECT_LT(glm::distance(VelocityAt(0, 1e-3), kMovement.start_velocity), 1e-4);
  EXPECT_LT(glm::length(AccelerationAt(0, 1e-3)), 0.05) << "of 20 m/s² at most on its way";
}

TEST(MinimumJerkAt, EndsAtZeroWithItsVelocityAndNoAcceleration) {
  EXPECT_EQ(At(kBlend_s), glm::dvec3(0));
  EXPECT_EQ(At(2 * kBlend_s), glm::dvec3(0));
  EXPECT_LT(glm::distance(VelocityAt(kBlend_s, -1e-3), kMovement.end_velocity), 1e-4);
  EXPECT_LT(glm::length(AccelerationAt(kBlend_s, -1e-3)), 0.05);
}

TEST(MinimumJerkAt, FromRestToRestIsFlashAndHogansMovement) {
  const Movement still{.start = {1, 0, 0}};
  for (double s : {0.1, 0.25, 0.5, 0.9}) {
    EXPECT_NEAR(MinimumJerkAt(still, s * 0.5, 0.5).x, 1 - (10 * s * s * s - 15 * s * s * s * s + 6 * s * s * s * s * s),
                1e-12);
  }
}

TEST(MinimumJerkAt, IsStraightWhereBothVelocitiesAreTheWayOverItsTime) {
  const Movement even{.start = {0.6, -0.3, 0}, .start_velocity = {-1, 0.5, 0}, .end_velocity = {-1, 0.5, 0}};
  for (double t : {0.1, 0.3, 0.5}) {
    EXPECT_LT(glm::distance(MinimumJerkAt(even, t, kBlend_s), (1 - t / kBlend_s) * even.start), 1e-12);
  }
}

class AllWays : public ::testing::TestWithParam<JoinStyle> {};

TEST_P(AllWays, ShowTheOldMotionsNextFrameFirstButForTheBlendsOwnBeginning) {
  const BodyMotion clips[] = {WavingClip(60), WavingClip(60, 2)};
  std::vector<Segment> way = Segments(19, 5, clips[1]);
  way.back().preferred = PreferredJoin{.blend_s = 1, .way = GetParam()};
  const Splice splice = SpliceSegments(clips, way, *FindJoin("minimum-jerk"));
  for (Role role : AllRoles()) {
    // At s = 1/30, 10 s³ of the gap is covered; the gap is at most 1.7 m here.
    EXPECT_LT(glm::distance(splice.motion.poses[20][role], clips[0].poses[20][role]), 10 * 1.7 / 27000 + 1e-3)
        << RoleName(role);
  }
}

TEST_P(AllWays, EndInTheNewMotionWhenTheWishSays) {
  const BodyMotion clips[] = {WavingClip(60), WavingClip(60, 2)};
  std::vector<Segment> way = Segments(19, 5, clips[1]);
  way.back().preferred = PreferredJoin{.blend_s = 0.4, .way = GetParam()};
  const Splice splice = SpliceSegments(clips, way, *FindJoin("minimum-jerk"));
  ExpectSamePose(splice.motion.poses[19 + 12], splice.wanted[12], 1e-9);
  EXPECT_GT(glm::distance(splice.motion.poses[19 + 6][Role::kLeftHand], splice.wanted[6][Role::kLeftHand]), 0.01);
}

INSTANTIATE_TEST_SUITE_P(MinimumJerk, AllWays, ::testing::Values(JoinStyle::kDecays, JoinStyle::kFades, JoinStyle::kDirect));

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
