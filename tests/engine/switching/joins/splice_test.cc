#include "engine/switching/joins/splice.h"

#include <gtest/gtest.h>

#include "engine/bridging/alignment.h"
#include "engine/switching/joins/inertialise.h"
#include "engine/bridging/one_character.h"
#include "engine/fuzzy/features.h"
#include "tests/engine/bridging/test_clips.h"

namespace etude {
namespace {

void ExpectSamePose(const BodyPose& a, const BodyPose& b, double tolerance) {
  for (Role role : AllRoles()) EXPECT_NEAR(glm::distance(a[role], b[role]), 0, tolerance) << RoleName(role);
}

void ExpectSameLimbs(const BodyMotion& motion, const BodyPose& expected) {
  for (const BodyPose& pose : motion.poses) {
    for (const Bone& bone : AllBones()) {
      ASSERT_NEAR(BoneLength(pose, bone), BoneLength(expected, bone), 1e-12) << RoleName(bone.child);
    }
  }
}

/// The largest second difference of any joint at a frame, metres.
double JumpAt(const BodyMotion& motion, int frame) {
  double worst = 0;
  for (Role role : AllRoles()) {
    worst = std::max(worst, glm::length(motion.poses[frame + 1][role] - 2.0 * motion.poses[frame][role] +
                                        motion.poses[frame - 1][role]));
  }
  return worst;
}

TEST(AlignOnFloor, UndoesATurnAndAWalk) {
  const BodyPose pose = WavingClip(1).poses[0];
  const BodyPose moved = FloorMove{.yaw = 2.5, .x = -3, .z = 7}.Apply(pose);
  ExpectSamePose(AlignOnFloor(moved, pose).Apply(moved), pose, 1e-12);
  EXPECT_NEAR(PoseGap(pose, moved), 0, 1e-12);
}

TEST(AlignOnFloor, KeepsHeightsAndLimbs) {
  const BodyPose high = [] {
    BodyPose pose = WavingClip(30).poses[29];
    for (glm::dvec3& joint : pose.joints) joint.y += 0.2;
    return pose;
  }();
  const BodyPose moved = AlignOnFloor(high, StandingClip(1, 0).poses[0]).Apply(high);
  ExpectSameLimbs({kJudgedRateHz, {moved}}, high);
  for (Role role : AllRoles()) EXPECT_EQ(moved[role].y, high[role].y);
}

TEST(PoseGap, IsTheWorstJoint) {
  const BodyPose pose = StandingClip(1, 0).poses[0];
  BodyPose other = pose;
  other[Role::kLeftHand].y += 0.3;
  other[Role::kRightFoot].y += 0.1;
  EXPECT_NEAR(PoseGap(pose, other), 0.3, 1e-12);
}

std::vector<Leg> Legs(int left, int entered, const BodyMotion& next) {
  return {{.clip = 0, .first = 0, .last = left, .own = {}},
          {.clip = 1, .first = entered, .last = static_cast<int>(next.poses.size()) - 1, .own = {}}};
}

const Join& Cut() { return *FindJoin("cut"); }
const Join& Spring() { return *FindJoin("inertialised-spring"); }

TEST(SpliceLegs, ReproducesAClipThatIsSwitchedIntoItself) {
  const BodyMotion clip = WavingClip(60);
  BodyMotion elsewhere = clip;
  for (BodyPose& pose : elsewhere.poses) pose = FloorMove{.yaw = 1, .x = 2, .z = 3}.Apply(pose);
  const BodyMotion clips[] = {clip, elsewhere};
  for (const Join& join : AllJoins()) {
    const Splice splice = SpliceLegs(clips, Legs(19, 19, clip), join);
    ASSERT_EQ(splice.motion.poses.size(), clip.poses.size());
    for (std::size_t f = 0; f < clip.poses.size(); ++f) ExpectSamePose(splice.motion.poses[f], clip.poses[f], 1e-9);
  }
}

TEST(SpliceLegs, PlaysTheOldClipToTheSeamAndTheNewOneAfterIt) {
  const BodyMotion clips[] = {WavingClip(40), WavingClip(30, 2)};
  const Splice splice = SpliceLegs(clips, Legs(19, 5, clips[1]), Cut());
  ASSERT_EQ(splice.motion.poses.size(), 20u + 24u);
  ASSERT_EQ(splice.seams.size(), 1u);
  EXPECT_EQ(splice.seams[0].frame, 19);
  for (int f = 0; f < 20; ++f) ExpectSamePose(splice.motion.poses[f], clips[0].poses[f], 0);
  for (int f = 20; f < 44; ++f) EXPECT_NEAR(PoseGap(splice.motion.poses[f], clips[1].poses[f - 14]), 0, 1e-9);
  ExpectSamePose(splice.seams[0].arriving_after, splice.motion.poses[20], 0);
  EXPECT_NEAR(Heading(splice.seams[0].arriving), Heading(splice.seams[0].leaving), 1e-12);
}

TEST(SpliceLegs, PassesThroughAnInBetween) {
  const BodyMotion clips[] = {WavingClip(40), WavingClip(30, 2), WavingClip(50, 4)};
  const std::vector<Leg> way = {{.clip = 0, .first = 0, .last = 10, .own = {}},
                                {.clip = 2, .first = 5, .last = 25, .own = {}},
                                {.clip = 1, .first = 3, .last = 29, .own = {}}};
  const Splice splice = SpliceLegs(clips, way, Cut());
  ASSERT_EQ(splice.seams.size(), 2u);
  EXPECT_EQ(splice.seams[0].frame, 10);
  EXPECT_EQ(splice.seams[1].frame, 10 + 20);
  EXPECT_EQ(splice.motion.poses.size(), 11u + 20u + 26u);
  EXPECT_NEAR(PoseGap(splice.motion.poses.back(), clips[1].poses.back()), 0, 1e-9);

  const Splice smooth = SpliceLegs(clips, way, Spring());
  for (int i : {0, 1}) {  // the gap belongs to the choice of frames, not to the join
    ExpectSamePose(smooth.seams[i].leaving, splice.seams[i].leaving, 0);
    ExpectSamePose(smooth.seams[i].arriving, splice.seams[i].arriving, 0);
  }
}

TEST(Inertialise, TakesTheJumpAwayAndKeepsTheLimbs) {
  const BodyMotion clips[] = {WavingClip(40), WavingClip(60, 5)};
  const Splice cut = SpliceLegs(clips, Legs(19, 5, clips[1]), Cut());
  const Splice smooth = SpliceLegs(clips, Legs(19, 5, clips[1]), Spring());
  const double jump_cut = std::max(JumpAt(cut.motion, 19), JumpAt(cut.motion, 20));
  const double jump_smooth = std::max(JumpAt(smooth.motion, 19), JumpAt(smooth.motion, 20));
  EXPECT_GT(jump_cut, 0.3) << "the control: these clips do not fit";
  EXPECT_LT(jump_smooth, 0.2 * jump_cut);
  ExpectSameLimbs(smooth.motion, clips[0].poses[0]);
  ExpectSamePose(smooth.motion.poses.back(), cut.motion.poses.back(), 0.01);
}

TEST(Inertialise, ShowsTheOldPoseAtTheSeamAndHalfTheOffsetAfterItsHalfLife) {
  const BodyPose hanging = StandingClip(1, 0).poses[0], raised = StandingClip(1, 60).poses[0];
  const Inertialiser offsets({hanging, hanging}, {raised, raised}, kJudgedRateHz, 0.1);
  ExpectSamePose(offsets.Apply(raised, 0), hanging, 1e-12);
  const auto arm_degrees = [&](double seconds) {
    return ComputeFeatures(offsets.Apply(raised, seconds), PosedBody::kStandingHipHeight)[Feature::kRH];
  };
  // Critically damped from rest: (1 + yt)e^−yt of the offset is left, with yt = 2 ln 2 after a half-life.
  EXPECT_NEAR(arm_degrees(0.1), 60 * (1 - (1 + 2 * std::log(2)) / 4), 1e-6);
  EXPECT_NEAR(arm_degrees(2), 60, 1e-3);
}

TEST(Inertialise, TurnsAnOppositeLimbAroundWithoutBreakingIt) {
  const BodyPose down = StandingClip(1, 0).poses[0], up = StandingClip(1, 180).poses[0];
  const Inertialiser offsets({down, down}, {up, up}, kJudgedRateHz, 0.1);
  const BodyPose halfway = offsets.Apply(up, 0.1);
  ExpectSamePose(offsets.Apply(up, 0), down, 1e-9);
  ExpectSameLimbs({kJudgedRateHz, {halfway}}, up);
}

TEST(PerformedBy, GivesEveryClipTheCharactersLimbsAndHeight) {
  BodyMotion small = WavingClip(40);
  for (BodyPose& pose : small.poses) {
    for (glm::dvec3& joint : pose.joints) joint = 0.6 * joint + glm::dvec3(0, 0.3, 0);
  }
  const Physique character = MakePhysique(StandingClip(1, 0).poses[0], 0.9);
  const BodyMotion performed = PerformedBy(character, small);
  const BodyMotion full_size = PerformedBy(character, WavingClip(40));
  EXPECT_NEAR(StandingHipHeight(performed.poses[0]), 0.9, 1e-12);
  for (std::size_t f = 0; f < performed.poses.size(); ++f) {
    ExpectSamePose(performed.poses[f], full_size.poses[f], 1e-9);
  }
  EXPECT_NEAR(performed.poses[0][Role::kLeftFoot].y, 0, 1e-12) << "set down on the floor";
}

}  // namespace
}  // namespace etude
