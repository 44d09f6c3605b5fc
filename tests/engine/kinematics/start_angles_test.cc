#include "engine/kinematics/start_angles.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/base/directions.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/solvers/ccd.h"
#include "tests/engine/kinematics/observed_tree.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

std::vector<AngleRange> NoLimits() { return std::vector<AngleRange>(29, AngleRange{-2 * kPi, 2 * kPi}); }

TEST(StartAngles, ReproduceEveryPoseOfTheTree) {
  for (int trial = 0; trial < 50; ++trial) {
    const BodyPose truth = ToBodyPose(Body(), RandomPose(Body(), trial, 0.9));
    ASSERT_OK(start, FindStartState(Body(), truth, NoLimits()));
    EXPECT_LT(WorstJointDistance(ToBodyPose(Body(), *start), truth), 1e-9) << trial;
  }
}

TEST(StartAngles, ReproduceStraightLimbs) {
  const TreeState standing = StandingState(Body());
  ASSERT_OK(start, FindStartState(Body(), ToBodyPose(Body(), standing), Body().limits));
  for (double angle : start->angles) EXPECT_NEAR(angle, 0, 1e-9);
}

TEST(StartAngles, StayWithinTheLimits) {
  for (int trial = 0; trial < 20; ++trial) {
    ASSERT_OK(start, FindStartState(Body(), ToBodyPose(Body(), RandomPose(Body(), trial, 1.0)), Body().limits));
    for (std::size_t i = 0; i < start->angles.size(); ++i) {
      EXPECT_GE(start->angles[i], Body().limits[i].lower);
      EXPECT_LE(start->angles[i], Body().limits[i].upper);
    }
  }
}

TEST(StartAngles, TheNextJointMakesUpForAClippedOne) {
  const BodyPose truth = ToBodyPose(Body(), RandomPose(Body(), 2, 0.6));
  std::vector<AngleRange> stiff_navel = NoLimits();
  for (int i = 0; i < 3; ++i) stiff_navel[Body().joints[kTreeNavel].first_dof + i] = {-0.01, 0.01};
  const BodyPose found = ToBodyPose(Body(), *FindStartState(Body(), truth, stiff_navel));
  EXPECT_GT(glm::distance(found[kShoulderCentre], truth[kShoulderCentre]), 0.01) << "the navel is clipped";
  EXPECT_LT(AngleBetween(found[kLeftElbow] - found[kLeftShoulder], truth[kLeftElbow] - truth[kLeftShoulder]), 1e-6);
}

TEST(StartAngles, ASittingBodyBendsAtItsHips) {
  TreeState sitting = StandingState(Body());
  sitting.angles[Body().joints[kTreeLeftKnee].first_dof] = Radians(90);
  sitting.angles[Body().joints[kTreeLeftHip].first_dof + 2] = Radians(-90);
  sitting.angles[Body().joints[kTreeRightHip].first_dof] = Radians(90);
  sitting.angles[Body().joints[kTreeRightKnee].first_dof] = Radians(-90);
  ASSERT_OK(start, FindStartState(Body(), ToBodyPose(Body(), sitting), Body().limits));
  for (std::size_t i = 0; i < sitting.angles.size(); ++i) EXPECT_NEAR(start->angles[i], sitting.angles[i], 1e-9) << i;
}

TEST(StartAngles, AnAngleBeyondHalfATurnIsClippedToTheNearerLimit) {
  const int raise = Body().joints[kTreeRightShoulder].first_dof;
  TreeState raised = StandingState(Body());
  raised.angles[raise] = Radians(185);  // the arm is up and slightly back, which Euler angles call -175°
  ASSERT_OK(start, FindStartState(Body(), ToBodyPose(Body(), raised), Body().limits));
  EXPECT_NEAR(Degrees(start->angles[raise]), 170, 1e-9);
}

TEST(StartAngles, TheHipsTellHowAStretchedLegWithPointedToesIsTurned) {
  BodyPose leap = ToBodyPose(Body(), StandingState(Body()));
  leap[kLeftFoot] = leap[kLeftAnkle] - glm::dvec3(0, 0.18, 0);
  ASSERT_OK(start, FindStartState(Body(), leap, NoLimits()));
  EXPECT_LT(WorstJointDistance(ToBodyPose(Body(), *start), leap), 1e-9);
}

TEST(StartAngles, UnusablePosesGiveNothing) {
  const BodyPose sound = ToBodyPose(Body(), StandingState(Body()));
  BodyPose lost = sound;
  lost[kRightWrist].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(FindStartState(Body(), lost, Body().limits));
  BodyPose collapsed = sound;
  collapsed[kLeftKnee] = collapsed[kLeftAnkle];
  EXPECT_FALSE(FindStartState(Body(), collapsed, Body().limits));
}

TEST(StartAngles, InverseKinematicsThenBringsTheEndsBackToWhereTheyWereSeen) {
  int solved = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const BodyPose truth = ToBodyPose(Body(), RandomPose(Body(), trial, 0.5));
    LimbObservation seen = Disturb(Observe(truth), trial, 0, 4);
    const BodyPose fixed = *FixLimbLengths(seen, {});
    const TreeState start = *FindStartState(Body(), fixed, Body().limits);
    const IkProblem problem = MakeImageProblem(PaperBody({}), seen, start);
    IkOptions options{.weights = WeightRule::kAdaptivePower, .max_iterations = 300, .trace = true};
    const IkSolution solution = SolveCcd(Body(), problem, options);
    const WorstError after = FindWorst(solution.errors, problem.targets);
    EXPECT_LT(after.position, 0.02) << trial;
    EXPECT_LT(after.position, solution.trace.front().worst_position);
    solved += solution.status == IkStatus::kConverged;
  }
  EXPECT_GE(solved, 3);
}

}  // namespace
}  // namespace etude
