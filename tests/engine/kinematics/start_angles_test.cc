#include "engine/base/directions.h"
#include "engine/kinematics/start_angles.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/solvers/ccd.h"
#include "tests/engine/kinematics/observed_tree.h"

namespace etude {
namespace {

using enum Role;

std::vector<AngleRange> NoLimits() { return std::vector<AngleRange>(29, AngleRange{-2 * kPi, 2 * kPi}); }

TEST(StartAngles, ReproduceEveryPoseOfTheTree) {
  const KinematicTree tree = MakeBodyTree({});
  for (int trial = 0; trial < 50; ++trial) {
    const BodyPose truth = ToBodyPose(tree, RandomPose(tree, trial, 0.9));
    const auto start = FindStartState(tree, truth, NoLimits());
    ASSERT_TRUE(start);
    EXPECT_LT(LargestGap(ToBodyPose(tree, *start), truth), 1e-9) << trial;
  }
}

TEST(StartAngles, ReproduceStraightLimbs) {
  const KinematicTree tree = MakeBodyTree({});
  const TreeState standing = StandingState(tree);
  const auto start = FindStartState(tree, ToBodyPose(tree, standing), tree.limits);
  ASSERT_TRUE(start);
  for (double angle : start->angles) EXPECT_NEAR(angle, 0, 1e-9);
}

TEST(StartAngles, StayWithinTheLimits) {
  const KinematicTree tree = MakeBodyTree({});
  for (int trial = 0; trial < 20; ++trial) {
    const auto start = FindStartState(tree, ToBodyPose(tree, RandomPose(tree, trial, 1.0)), tree.limits);
    ASSERT_TRUE(start);
    for (std::size_t i = 0; i < start->angles.size(); ++i) {
      EXPECT_GE(start->angles[i], tree.limits[i].lower);
      EXPECT_LE(start->angles[i], tree.limits[i].upper);
    }
  }
}

TEST(StartAngles, TheNextJointMakesUpForAClippedOne) {
  const KinematicTree tree = MakeBodyTree({});
  const BodyPose truth = ToBodyPose(tree, RandomPose(tree, 2, 0.6));
  std::vector<AngleRange> stiff_navel = NoLimits();
  for (int i = 0; i < 3; ++i) stiff_navel[tree.joints[kTreeNavel].first_dof + i] = {-0.01, 0.01};
  const BodyPose found = ToBodyPose(tree, *FindStartState(tree, truth, stiff_navel));
  EXPECT_GT(glm::distance(found[kShoulderCentre], truth[kShoulderCentre]), 0.01) << "the navel is clipped";
  EXPECT_LT(AngleBetween(found[kLeftElbow] - found[kLeftShoulder], truth[kLeftElbow] - truth[kLeftShoulder]), 1e-6);
}

TEST(StartAngles, ASittingBodyBendsAtItsHips) {
  const KinematicTree tree = MakeBodyTree({});
  TreeState sitting = StandingState(tree);
  sitting.angles[tree.joints[kTreeLeftKnee].first_dof] = Radians(90);
  sitting.angles[tree.joints[kTreeLeftHip].first_dof + 2] = Radians(-90);
  sitting.angles[tree.joints[kTreeRightHip].first_dof] = Radians(90);
  sitting.angles[tree.joints[kTreeRightKnee].first_dof] = Radians(-90);
  const auto start = FindStartState(tree, ToBodyPose(tree, sitting), tree.limits);
  ASSERT_TRUE(start);
  for (std::size_t i = 0; i < sitting.angles.size(); ++i) EXPECT_NEAR(start->angles[i], sitting.angles[i], 1e-9) << i;
}

TEST(StartAngles, AnAngleBeyondHalfATurnIsClippedToTheNearerLimit) {
  const KinematicTree tree = MakeBodyTree({});
  const int raise = tree.joints[kTreeRightShoulder].first_dof;
  TreeState raised = StandingState(tree);
  raised.angles[raise] = Radians(185);  // the arm straight up and a little back; Euler angles call it -175
  const auto start = FindStartState(tree, ToBodyPose(tree, raised), tree.limits);
  ASSERT_TRUE(start);
  EXPECT_NEAR(Degrees(start->angles[raise]), 170, 1e-9);
}

TEST(StartAngles, TheHipsTellHowAStretchedLegWithPointedToesIsTurned) {
  const KinematicTree tree = MakeBodyTree({});
  BodyPose leap = ToBodyPose(tree, StandingState(tree));
  leap[kLeftFoot] = leap[kLeftAnkle] - glm::dvec3(0, 0.18, 0);
  const auto start = FindStartState(tree, leap, NoLimits());
  ASSERT_TRUE(start);
  EXPECT_LT(LargestGap(ToBodyPose(tree, *start), leap), 1e-9);
}

TEST(StartAngles, UnusablePosesGiveNothing) {
  const KinematicTree tree = MakeBodyTree({});
  const BodyPose sound = ToBodyPose(tree, StandingState(tree));
  BodyPose lost = sound;
  lost[kRightWrist].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(FindStartState(tree, lost, tree.limits));
  BodyPose collapsed = sound;
  collapsed[kLeftKnee] = collapsed[kLeftAnkle];
  EXPECT_FALSE(FindStartState(tree, collapsed, tree.limits));
}

TEST(StartAngles, InverseKinematicsThenBringsTheEndsBackToWhereTheyWereSeen) {
  const KinematicTree tree = MakeBodyTree({});
  int solved = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const BodyPose truth = ToBodyPose(tree, RandomPose(tree, trial, 0.5));
    LimbObservation seen = Disturb(Observe(truth), trial, 0, 4);
    const BodyPose fixed = *FixLimbLengths(seen, {});
    const TreeState start = *FindStartState(tree, fixed, tree.limits);
    const IkProblem problem = MakeImageProblem(PaperBody({}), seen, start);
    IkOptions options;
    options.weights = WeightRule::kAdaptivePower;
    options.max_iterations = 300;
    options.trace = true;
    const IkSolution solution = SolveCcd(tree, problem, options);
    const WorstError after = FindWorst(solution.errors, problem.targets);
    EXPECT_LT(after.position, 0.02) << trial;
    EXPECT_LT(after.position, solution.trace.front().worst_position);
    solved += solution.status == IkStatus::kConverged;
  }
  EXPECT_GE(solved, 3);
}

}  // namespace
}  // namespace etude
