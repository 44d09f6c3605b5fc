#include "engine/transitions/joins/planted_feet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "engine/motion/body.h"
#include "engine/transitions/joins/limbs.h"
#include "engine/transitions/joins/placing.h"
#include "engine/transitions/joins/splice.h"
#include "tests/engine/transitions/expect_pose.h"
#include "tests/engine/transitions/joins/join_pictures.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

/// Stands on both feet, the left one `ahead` metres in front, with knees bent as needed.
BodyPose Stride(double ahead) {
  BodyPose pose = StandingClip(1, 20).poses[0];
  constexpr double kSink = 0.08;
  for (glm::dvec3& joint : pose.joints) joint.y -= kSink;
  double side = 0.5;
  for (const LegRoles& leg : kLegs) {
    const BodyPose rest = StandingClip(1, 20).poses[0];
    const double thigh = glm::distance(rest[leg.hip], rest[leg.knee]);
    const double shin = glm::distance(rest[leg.knee], rest[leg.ankle]);
    const glm::dvec3 ankle = rest[leg.ankle] + glm::dvec3(0, 0, side * ahead);
    const Leg solved = SolveLeg(pose[leg.hip], ankle, thigh, shin, {0, 0, 1});
    pose[leg.knee] = solved.knee;
    pose[leg.ankle] = solved.ankle;
    pose[leg.foot] = solved.ankle + rest[leg.foot] - rest[leg.ankle];
    side = -side;
  }
  const double floor = std::min(pose[Role::kLeftFoot].y, pose[Role::kRightFoot].y);
  for (glm::dvec3& joint : pose.joints) joint.y -= floor;
  return pose;
}

BodyMotion Still(const BodyPose& pose, int frames) {
  return {kJudgedRateHz, std::vector<BodyPose>(static_cast<std::size_t>(frames), pose)};
}

JoinWindow Window(const BodyPose& from, const BodyPose& to, int frames) {
  JoinWindow window{.shown = {from, from}, .target_before = to, .old = {}, .next = {}};
  window.old.assign(frames + 1, from);
  window.next.assign(frames + 1, to);
  window.old_frames = window.next_frames = frames;
  return window;
}

TEST(AlignOnPlantedFeet, LaysStandingFeetOntoEachOtherExactly) {
  const BodyPose stride = Stride(0.3);
  const FloorMove away{.yaw = 0.8, .x = 3, .z = -2};
  const std::vector<BodyPose> old(10, stride), next(10, away.Apply(stride));
  const FloorMove place = AlignOnPlantedFeet(old, next, 30);
  ExpectSamePose(place.Apply(next[0]), stride, 1e-12);
}

TEST(AlignOnPlantedFeet, TrustsFeetThatStandMoreThanATrunkThatLeans) {
  const BodyPose stride = Stride(0.3);
  BodyPose leaning = stride;
  for (const Role role : {Role::kLeftHip, Role::kRightHip, Role::kLeftShoulder, Role::kRightShoulder, Role::kHipCentre,
                          Role::kSpine, Role::kShoulderCentre, Role::kHead}) {
    leaning[role].x += 0.2;
  }
  const std::vector<BodyPose> old(16, stride), next(16, leaning);
  const FloorMove by_feet = AlignOnPlantedFeet(old, next, 30);
  const FloorMove by_hips = AlignOnFloor(leaning, stride);
  EXPECT_NEAR(by_hips.x, -0.2, 1e-9) << "the control";
  EXPECT_LT(std::abs(by_feet.x), 0.07);
}

TEST(AlignOnPlantedFeet, TurnsNobodyAboutForItsFeet) {
  const BodyPose stride = Stride(0.5);
  for (double degrees : {10.0, 25.0, 90.0, 180.0}) {
    BodyPose straddle = stride;  // its feet are turned under an unturned trunk
    for (const LegRoles& leg : kLegs) {
      for (Role role : {leg.ankle, leg.foot}) straddle[role] = FloorMove{.yaw = Radians(degrees)}.Apply(stride[role]);
    }
    const std::vector<BodyPose> old(16, stride), next(16, straddle);
    const double turned = Degrees(std::abs(std::remainder(AlignOnPlantedFeet(old, next, 30).yaw, 2 * kPi)));
    EXPECT_LE(turned, 30 + 1e-9) << degrees;
    EXPECT_GT(turned, 0.7 * std::min(degrees, 30.0)) << degrees;
  }
}

TEST(PlanSteps, LetsFeetThatMustTravelGoOneAfterTheOther) {
  const auto [steps, unplanted_frames] = PlanSteps(Window(Stride(0.15), Stride(-0.15), 30));
  EXPECT_EQ(unplanted_frames, 0);
  for (const FootStep& step : steps) {
    EXPECT_FALSE(step.keeps);
    EXPECT_GT(step.lift, 0.02);
    EXPECT_LT(step.begin, step.end);
  }
  EXPECT_TRUE(steps[0].end <= steps[1].begin || steps[1].end <= steps[0].begin);
}

void Lift(Role foot, int first, int last, std::vector<BodyPose>& poses) {
  const Role ankle = *ParentOf(foot);
  for (int f = first; f <= last; ++f) {
    for (Role role : {foot, ankle}) poses[f][role].y += 0.15;
  }
}

TEST(PlanSteps, LeavesAFootStandingWhoseOwnMotionLiftsItWhileTheOtherTravels) {
  JoinWindow window = Window(Stride(0.15), Stride(-0.15), 30);
  // Both motions lift the right foot at once, so the left foot has no time to step.
  Lift(Role::kRightFoot, 8, 30, window.old);
  Lift(Role::kRightFoot, 0, 14, window.next);
  const auto [steps, unplanted_frames] = PlanSteps(window);
  EXPECT_EQ(unplanted_frames, 0);
  EXPECT_TRUE(steps[1].stays_from < steps[1].begin || steps[1].waits_until > steps[1].end);
}

TEST(PlanSteps, LetsFeetThatSlideInTheirClipsStayWhereTheyStand) {
  JoinWindow window = Window(Stride(0.15), Stride(-0.15), 30);
  for (std::vector<BodyPose>* clip : {&window.old, &window.next}) {
    for (std::size_t f = 0; f < clip->size(); ++f) {
      for (glm::dvec3& joint : (*clip)[f].joints) joint.z += 0.1 * static_cast<double>(f) / window.rate_hz;
    }
  }
  const auto [steps, unplanted_frames] = PlanSteps(window);
  EXPECT_EQ(unplanted_frames, 0);
  int long_stands = 0;
  for (const FootStep& step : steps) {
    // A foot that follows the clip for 0.3 s slides by 3 cm. This costs more than an abrupt stop from 10 cm/s.
    if (step.begin >= 9) {
      EXPECT_EQ(step.stays_from, 0);
    }
    if (step.end <= 21) {
      EXPECT_EQ(step.waits_until, 30);
    }
    long_stands += (step.begin >= 9) + (step.end <= 21);
  }
  EXPECT_GE(long_stands, 2) << "one after the other";
}

TEST(PlanSteps, SharesATurnOfTheBodyAmongBothFeet) {
  constexpr double kTurn = 100;
  const JoinWindow window = Window(Stride(0.1), FloorMove{.yaw = Radians(kTurn)}.Apply(Stride(0.1)), 36);
  for (const FootStep& step : PlanSteps(window).steps) {
    // The hips turn by the minimum-jerk curve. A standing foot is twisted against the hips by their turn before its
    // step, and after its step by the rest of the turn.
    const double before = kTurn * Smootherstep(step.begin / 36.0), after = kTurn * (1 - Smootherstep(step.end / 36.0));
    EXPECT_LE(std::max(before, after), 0.6 * kTurn) << step.begin << " to " << step.end;
  }
}

TEST(PlanSteps, CountsTheFramesInWhichNothingCanStand) {
  JoinWindow window = Window(Stride(0.15), Stride(-0.15), 10);  // too short for two steps
  EXPECT_GT(PlanSteps(window).unplanted_frames, 3);
}

TEST(PlanSteps, DoesNotLiftFeetThatStandWhereTheyShould) {
  const FootPlan plan = PlanSteps(Window(Stride(0.2), Stride(0.2), 15));
  EXPECT_EQ(plan.unplanted_frames, 0);
  for (const FootStep& step : plan.steps) EXPECT_EQ(step.lift, 0);
}

TEST(PlantFeet, KeepsEachFootInItsPlaceUntilItsStepAndAfterIt) {
  const BodyPose from = Stride(0.3), to = Stride(-0.3);
  const JoinWindow window = Window(from, to, 24);
  const FootPlan plan = PlanSteps(window);
  EXPECT_EQ(plan.unplanted_frames, 0);
  std::vector<BodyPose> played = PlayMinimumJerk(window, JoinStyle::kDecays);
  PlantFeet(window, plan, played);
  for (std::size_t side = 0; side < kLegs.size(); ++side) {
    for (int f = 0; f <= 24; ++f) {
      const Role foot = kLegs[side].foot;
      if (f <= plan.steps[side].begin) {
        EXPECT_LT(glm::distance(played[f][foot], from[foot]), 0.005) << f;
      }
      if (f >= plan.steps[side].end) {
        EXPECT_LT(glm::distance(played[f][foot], to[foot]), 0.005) << f;
      }
    }
  }
}

TEST(PlantFeet, KeepsAllLimbsToTheLastDigits) {
  const JoinWindow window = Window(Stride(0.4), FloorMove{.yaw = 0.7, .x = 0.5, .z = 0.1}.Apply(Stride(-0.2)), 20);
  std::vector<BodyPose> played = PlayMinimumJerk(window, JoinStyle::kFades);
  PlantFeet(window, PlanSteps(window), played);
  for (const BodyPose& pose : played) {
    for (const Bone& bone : AllBones()) {
      EXPECT_NEAR(BoneLength(pose, bone), BoneLength(window.next[0], bone), 1e-12) << RoleName(bone.child);
    }
  }
}

double SlideOf(const Splice& splice, int frames) {
  double slide = 0;
  const int point = splice.points.front().frame;
  for (int f = point; f < point + frames; ++f) {
    for (const LegRoles& leg : kLegs) {
      const glm::dvec3 &here = splice.motion.poses[f][leg.foot], &next = splice.motion.poses[f + 1][leg.foot];
      if (std::max(here.y, next.y) < 0.02) slide += std::hypot(next.x - here.x, next.z - here.z);
    }
  }
  return slide;
}

TEST(PlantedFeet, DoesNotSlideWhereLimbsAloneDo) {
  const BodyMotion clips[] = {Still(Stride(0.3), 60), Still(Stride(-0.3), 60)};
  std::vector<Segment> way = Segments(19, 5, clips[1]);
  way.back().preferred = PreferredJoin{.blend_s = 0.8};
  const double limbs = SlideOf(SpliceSegments(clips, way, *FindJoin("minimum-jerk")), 24);
  const double feet = SlideOf(SpliceSegments(clips, way, *FindJoin("planted-feet")), 24);
  EXPECT_GT(limbs, 0.3) << "the control slides";
  EXPECT_LT(feet, 0.1 * limbs);
}

TEST(SolveLeg, IsTheLegItWasMeasuredFrom) {
  const glm::dvec3 hip(0.1, 0.9, 0), knee(0.15, 0.5, 0.2), ankle(0.05, 0.1, 0.05);
  const Leg leg =
      SolveLeg(hip, ankle, glm::distance(hip, knee), glm::distance(knee, ankle), KneeOffset(hip, knee, ankle));
  EXPECT_LT(glm::distance(leg.knee, knee), 1e-12);
  EXPECT_LT(glm::distance(leg.ankle, ankle), 1e-12);
}

TEST(SolveLeg, KeepsItsLimbsAndItsDirectionWhereItCannotReach) {
  const Leg far = SolveLeg({0, 1, 0}, {0, -1, 0}, 0.4, 0.35, {0, 0, 1});
  EXPECT_NEAR(far.ankle.y, 0.25, 1e-9);
  EXPECT_NEAR(glm::distance(far.knee, far.ankle), 0.35, 1e-12);
  const Leg nowhere = SolveLeg({0, 1, 0}, {0, 1, 0}, 0.4, 0.35, {0, 0, 0});
  EXPECT_NEAR(glm::distance(nowhere.knee, nowhere.ankle), 0.35, 1e-12);
  EXPECT_NEAR(glm::distance(nowhere.knee, {0, 1, 0}), 0.4, 1e-9);
}

TEST(CarriedOffset, TurnsWithTheLeg) {
  const glm::dvec3 carried = CarriedOffset({0, 0, 0.1}, {0, -1, 0}, {0, 0, 1});  // from down to forwards, about x
  EXPECT_LT(glm::distance(carried, glm::dvec3(0, 0.1, 0)), 1e-12);
}

/// Returns Stride with each knee mirrored to the back of the line from hip to ankle.
BodyPose Overextended(double ahead) {
  BodyPose pose = Stride(ahead);
  for (const LegRoles& leg : kLegs) {
    pose[leg.knee] -= 2.0 * KneeOffset(pose[leg.hip], pose[leg.knee], pose[leg.ankle]);
  }
  return pose;
}

TEST(PlantFeet, DoesNotBendALegBackwardsThatItsClipsShowOverextended) {
  const BodyPose from = Overextended(0.1);
  const BodyPose to = FloorMove{.x = 0.3}.Apply(Overextended(-0.1));
  const JoinWindow window = Window(from, to, 30);
  std::vector<BodyPose> played = PlayMinimumJerk(window, JoinStyle::kDirect);
  PlantFeet(window, PlanSteps(window), played);
  const auto behind = [](const BodyPose& pose) {
    double most = -1;
    for (const LegRoles& leg : kLegs)
      most = std::max(most, -KneeOffset(pose[leg.hip], pose[leg.knee], pose[leg.ankle]).z);
    return most;
  };
  ASSERT_GT(behind(from), 0.03);
  for (const BodyPose& pose : played) EXPECT_LE(behind(pose), behind(from) + 0.005) << "while the knees turn";
  EXPECT_LT(behind(played[15]), 0) << "in the middle both knees are in front";
}

}  // namespace
}  // namespace etude
