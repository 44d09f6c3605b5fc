#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "engine/keypoints/recover_person.h"
#include "tests/engine/keypoints/walkers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kWalkFrames = 40;

std::vector<LandmarkPositions> Walk(double sigma_m) {
  RandomStream dice = WalkersDice("walk");
  std::vector<LandmarkPositions> frames;
  for (std::size_t k = 0; k < kWalkFrames; ++k) {
    frames.push_back(Walker(0.4, -0.3, static_cast<double>(k) / 30));
    for (auto& place : frames.back()) {
      if (place) *place += sigma_m * glm::dvec3(dice.Normal(), dice.Normal(), dice.Normal());
    }
  }
  return frames;
}

/// Returns Σ |place − joint|² over the joints that have landmarks, m².
double SquaresOff(const CaptureBody& body, const TreeState& state, const LandmarkPositions& landmarks) {
  const BodyPose pose = ToBodyPose(body, state);
  const RoleVectors joints = JointsOf(landmarks);
  double sum = 0;
  for (const Role role : AllRoles()) {
    if (!joints[Index(role)]) continue;
    const glm::dvec3 off = *joints[Index(role)] - pose[role];
    sum += glm::dot(off, off);
  }
  return sum;
}

TEST(MedianBody, HasTheBonesOfMostFrames) {
  std::vector<LandmarkPositions> frames = Walk(0);
  for (std::size_t k = 0; k < kWalkFrames / 3; ++k) *frames[k][Index(Landmark::kLeftKnee)] += glm::dvec3(0.3, 0, 0);
  ASSERT_OK(body, MedianBody(frames));
  const auto bone = [&](Role role) { return body->bones[Index(role)]; };
  EXPECT_NEAR(bone(Role::kLeftKnee), 0.43, 1e-9);
  EXPECT_NEAR(bone(Role::kRightAnkle), 0.42, 1e-9);
  EXPECT_NEAR(bone(Role::kLeftFoot), 0.18, 1e-9);
  EXPECT_NEAR(bone(Role::kSpine) + bone(Role::kShoulderCentre), 0.5, 1e-9);
  EXPECT_NEAR(bone(Role::kHead), 0.25, 1e-9);
}

TEST(MedianBody, SaysWhichBoneNobodySaw) {
  std::vector<LandmarkPositions> frames = Walk(0);
  for (LandmarkPositions& frame : frames) frame[Index(Landmark::kRightElbow)].reset();
  EXPECT_THAT(testing::Message(MedianBody(frames)), HasSubstr("no frame shows both right_elbow and right_shoulder"));
}

TEST(FitPerson, GivesAKnownMotionBack) {
  const std::vector<LandmarkPositions> frames = Walk(0);
  const CaptureBody body = MedianBody(frames).value();
  const auto states = FitPerson(body, frames);
  for (std::size_t k = 0; k < kWalkFrames; ++k) {
    ASSERT_TRUE(states[k]);
    EXPECT_LT(SquaresOff(body, *states[k], frames[k]), 1e-10) << k;
  }
}

TEST(FitPerson, NoOtherPoseNearbyIsNearerToNoisyPoints) {
  const std::vector<LandmarkPositions> frames = Walk(0.02);
  const CaptureBody body = MedianBody(frames).value();
  const auto states = FitPerson(body, frames);
  for (std::size_t k = 0; k < kWalkFrames; k += 5) {
    ASSERT_TRUE(states[k]);
    const double least = SquaresOff(body, *states[k], frames[k]);
    for (std::size_t dof = 0; dof < states[k]->angles.size(); ++dof) {
      for (const double step : {-Radians(2), Radians(2)}) {
        TreeState other = *states[k];
        other.angles[dof] += step;
        EXPECT_GT(SquaresOff(body, other, frames[k]), 0.99 * least) << k << ", angle " << dof;
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-0.005, 0.005}) {
        TreeState other = *states[k];
        other.root_position[axis] += step;
        EXPECT_GT(SquaresOff(body, other, frames[k]), least) << k << ", axis " << axis;
      }
    }
  }
}

TEST(FitPerson, ATrunkThatIsSeenShorterDoesNotBuckle) {
  const CaptureBody body = MedianBody(Walk(0)).value();
  std::vector<LandmarkPositions> frames = Walk(0);
  for (LandmarkPositions& frame : frames) {
    for (const Landmark hip : {Landmark::kLeftHip, Landmark::kRightHip}) *frame[Index(hip)] += glm::dvec3(0, 0.01, 0);
  }
  for (const auto& state : FitPerson(body, frames)) {
    ASSERT_TRUE(state);
    const BodyPose pose = ToBodyPose(body, *state);
    const glm::dvec3 lower = glm::normalize(pose[Role::kSpine] - pose[Role::kHipCentre]);
    const glm::dvec3 upper = glm::normalize(pose[Role::kShoulderCentre] - pose[Role::kSpine]);
    EXPECT_GT(glm::dot(lower, upper), std::cos(Radians(4)));
  }
}

TEST(FitPerson, KeepsTheOthersWhereALandmarkIsLackingAndLeavesEmptyFramesOut) {
  std::vector<LandmarkPositions> frames = Walk(0);
  const CaptureBody body = MedianBody(frames).value();
  for (std::size_t k = 10; k < 20; ++k) {
    for (const Landmark lost : {Landmark::kLeftBigToe, Landmark::kLeftAnkle, Landmark::kRightWrist}) {
      frames[k][Index(lost)].reset();
    }
  }
  frames[25] = {};
  const auto states = FitPerson(body, frames);
  for (std::size_t k = 0; k < kWalkFrames; ++k) {
    ASSERT_EQ(states[k].has_value(), k != 25);
    if (k == 25) continue;
    EXPECT_LT(SquaresOff(body, *states[k], frames[k]), 2e-4) << k;
  }
}

}  // namespace
}  // namespace etude
