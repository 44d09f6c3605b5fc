#include "engine/capture/fit_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/motion/rest_body.h"
#include "tests/engine/capture/marked_body.h"
#include "tests/engine/kinematics/rest_bodies.h"
#include "tests/support/gaps.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

CaptureBody PlainBody() {
  const std::vector<BodyPose> poses = {ModelPose()};
  return FittedBody(RestBodyOf(poses)).value();
}

// Returns a random pose of a body: angles within a radian, turned about the vertical axis.
TreeState SomePose(const CaptureBody& body, int trial) {
  TreeState state = StandingState(body.tree);
  state.root_position = {0.3, 0.05, -0.2};
  const double yaw = 0.7 * trial;
  state.root_frame = glm::dmat3(std::cos(yaw), 0, -std::sin(yaw), 0, 1, 0, std::sin(yaw), 0, std::cos(yaw));
  for (std::size_t i = 0; i < state.angles.size(); ++i) {
    state.angles[i] = 0.8 * std::sin(1.7 * static_cast<double>(i) + 2.3 * trial);
  }
  return state;
}

// A depth sensor's hips and shoulders move relative to the trunk. A chest joint without a target may bend either way.
TEST(PoseFitter, FindsEveryPoseOfABodyFromItsJoints) {
  for (const auto& [body, within] : {std::pair(PlainBody(), 1e-6),
                                     {FittedBody(SensorRestBody()).value(), 1e-6},
                                     {FittedBody(JointedRestBody()).value(), 5e-5}}) {
    const PoseFitter fitter(body);
    for (int trial = 0; trial < 30; ++trial) {
      const BodyPose truth = ToBodyPose(body, SomePose(body, trial));
      ASSERT_OK(found, fitter.Fit(TargetsAt(truth)));
      EXPECT_LT(WorstJointDistance(ToBodyPose(body, found->state), truth), within) << trial;
    }
  }
}

TEST(PoseFitter, FindsPosesOfPaperBsBodyWithinIt) {
  const std::vector<BodyPose> poses = {ModelPose(0), ModelPose(0.3), ModelPose(1), ModelPose(2)};
  const CaptureBody body = FittedBody(RestBodyOf(poses)).value();
  const PoseFitter fitter(body);
  for (const BodyPose& pose : poses) {
    EXPECT_LT(WorstJointDistance(ToBodyPose(body, fitter.Fit(TargetsAt(pose))->state), pose), 1e-6);
  }
}

// The spine has no target. The fitter chooses how the back bends, and places all other joints exactly.
TEST(PoseFitter, LeavesWhatNobodySeesToTheBody) {
  const CaptureBody body = PlainBody();
  const PoseFitter fitter(body);
  const BodyPose truth = ToBodyPose(body, SomePose(body, 4));
  PoseTargets wanted = TargetsAt(truth);
  wanted.weights[Index(kSpine)] = 0;
  wanted.places[kSpine] = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
  ASSERT_OK(found, fitter.Fit(wanted));
  const BodyPose pose = ToBodyPose(body, found->state);
  for (const Role role : AllRoles()) {
    if (role == kSpine) continue;
    EXPECT_LT(glm::distance(pose[role], truth[role]), 1e-6) << RoleName(role);
  }
  EXPECT_GT(glm::distance(pose[kSpine], truth[kSpine]), 1e-3) << "the control";
}

// The body cannot stretch its arm this far, so the joints get the best common fit.
TEST(PoseFitter, ComesAsNearAsItCanToJointsThatFitNoBody) {
  const CaptureBody body = PlainBody();
  const PoseFitter fitter(body);
  BodyPose wanted = ToBodyPose(body, SomePose(body, 2));
  const glm::dvec3 along = wanted[kLeftHand] - wanted[kLeftWrist];
  wanted[kLeftHand] += 0.5 * along;
  const BodyPose found = ToBodyPose(body, fitter.Fit(TargetsAt(wanted))->state);
  // The hand's two ends share the missing length; no other joint is further off.
  EXPECT_NEAR(glm::distance(found[kLeftHand], found[kLeftWrist]), glm::length(along), 1e-9);
  EXPECT_LT(WorstJointDistance(found, wanted), 0.5 * glm::length(along));
  EXPECT_GT(WorstJointDistance(found, wanted), 0.1 * glm::length(along));
}

TEST(PoseFitter, RefusesWhatIsNotFiniteAndABodyWithoutAPlace) {
  const CaptureBody body = PlainBody();
  const PoseFitter fitter(body);
  PoseTargets wanted = TargetsAt(ToBodyPose(body, SomePose(body, 0)));
  wanted.weights[Index(kLeftFoot)] = 0;
  EXPECT_FALSE(fitter.Fit(wanted));
  wanted = TargetsAt(ToBodyPose(body, SomePose(body, 0)));
  wanted.places[kHead].x = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(fitter.Fit(wanted));
}

}  // namespace
}  // namespace etude
