#include "engine/recognition/pose_vector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/recognition/sight.h"
#include "tests/engine/recognition/waving_body.h"

namespace etude {
namespace {

constexpr std::size_t kHeadPart = 0, kLeftWristPart = 5, kRightUpperArmPart = 4, kHipLift = 11;

PoseVector Described(const SkeletonStream& stream, PoseParts parts) {
  LiveSight sight({}, stream.rate_hz);
  StepDescriber describer(parts, {.weighting = Weighting::kAdaptive}, stream.rate_hz);
  for (const SensedFrame& frame : stream.frames) describer.Update(sight.Update(frame));
  return *describer.Step();
}

PoseVector Described(const BodyPose& pose, PoseParts parts) {
  return Described(StreamOf(BodyMotion{.poses = std::vector<BodyPose>(40, pose)}), parts);
}

double FurthestPart(const PoseVector& a, const PoseVector& b) {
  double furthest = 0;
  for (std::size_t i = 0; i < kPosePartCount; ++i) furthest = std::max(furthest, glm::distance(a.parts[i], b.parts[i]));
  return furthest;
}

TEST(PoseVector, HasJointsFromTheHipsWithATrunkOfHalfAMetreAndLimbsOfLengthOne) {
  const BodyPose pose = ArmsRaised(0.4, 1.1);
  const PoseVector joints = Described(pose, PoseParts::kJoints), limbs = Described(pose, PoseParts::kLimbs);
  // The trunk is 0.5 m long, so nothing is scaled.
  EXPECT_LT(glm::distance(joints.parts[kHeadPart], glm::dvec3(0, 0.75, 0)), 1e-9);
  const glm::dvec3 wrist = pose[Role::kLeftWrist] - pose[Role::kHipCentre];
  EXPECT_LT(glm::distance(joints.parts[kLeftWristPart], wrist), 1e-9);
  EXPECT_LT(glm::distance(limbs.parts[kRightUpperArmPart], glm::dvec3(-std::sin(1.1), -std::cos(1.1), 0)), 1e-9);
  for (const PoseVector& each : {joints, limbs}) {
    for (const double weight : each.weights) EXPECT_EQ(weight, 1) << "all is tracked";
    EXPECT_LT(std::abs(each.parts[kHipLift].y), 0.05) << "standing";
  }
  BodyPose lower = pose;
  for (const Role role : AllRoles()) lower[role].y -= role == Role::kLeftFoot || role == Role::kRightFoot ? 0 : 0.2;
  const auto lift = Described(lower, PoseParts::kJoints).parts[kHipLift].y - joints.parts[kHipLift].y;
  EXPECT_NEAR(lift, -0.2, 0.03) << "hips of 0.9 m that came down by 0.2";
}

TEST(PoseVector, IsTheSameOfAnyBodyAnywhereFacingAnywhere) {
  const BodyPose moved = ArmsRaised(0.4, 1.1, 1.3, {.yaw = 2.1, .x = 3, .z = -1});
  for (const PoseParts parts : {PoseParts::kJoints, PoseParts::kLimbs}) {
    EXPECT_LT(FurthestPart(Described(moved, parts), Described(ArmsRaised(0.4, 1.1), parts)), 1e-6);
    EXPECT_GT(FurthestPart(Described(ArmsRaised(1.1, 0.4), parts), Described(ArmsRaised(0.4, 1.1), parts)), 0.2);
  }
}

TEST(PoseVector, OfTheMirrorImageIsTheMirrorImage) {
  const BodyPose pose = ArmsRaised(0.4, 1.1);
  BodyPose image;
  for (const Role role : AllRoles()) image[Mirrored(role)] = pose[role] * glm::dvec3(-1, 1, 1);
  SkeletonStream stream = StreamOf(BodyMotion{.poses = std::vector<BodyPose>(40, pose)});
  SkeletonStream mirrored = StreamOf(BodyMotion{.poses = std::vector<BodyPose>(40, image)});
  for (SensedFrame& frame : stream.frames) frame[Role::kLeftElbow].state = TrackingState::kInferred;
  for (SensedFrame& frame : mirrored.frames) frame[Role::kRightElbow].state = TrackingState::kInferred;
  for (const PoseParts parts : {PoseParts::kJoints, PoseParts::kLimbs}) {
    const PoseVector wanted = Described(mirrored, parts), found = Mirrored(Described(stream, parts), parts);
    EXPECT_LT(FurthestPart(found, wanted), 1e-9);
    EXPECT_EQ(found.weights, wanted.weights);
    EXPECT_NE(found.weights, Described(stream, parts).weights) << "the control";
  }
}

TEST(PoseVector, DistancesAreWeighedByWhatWasSeen) {
  PoseVector seen, taught;
  seen.parts[0] = {3, 0, 0};
  seen.parts[1] = {0, 0, 2};
  EXPECT_EQ(SquaredDistance(seen, taught), 0) << "nothing was seen";
  seen.weights[0] = 0.5;
  EXPECT_DOUBLE_EQ(SquaredDistance(seen, taught), 9);
  seen.weights[1] = 1;
  EXPECT_DOUBLE_EQ(SquaredDistance(seen, taught), (0.5 * 9 + 4) / 1.5);
  taught.parts[1] = {0, 0, 2};
  EXPECT_DOUBLE_EQ(SquaredDistance(seen, taught), 0.5 * 9 / 1.5);
  const PoseVector mean = MeanOf(std::vector{seen, taught});
  EXPECT_EQ(mean.parts[0], glm::dvec3(1.5, 0, 0));
  EXPECT_EQ(mean.parts[1], glm::dvec3(0, 0, 2));
  EXPECT_EQ(mean.weights, seen.weights);
}

TEST(StepDescriber, GivesFifteenStepsASecondAtAnyRateAndNoneWithoutABody) {
  for (const double rate_hz : {10.0, 15.0, 30.0, 50.0}) {
    SkeletonStream stream =
        StreamOf(BodyMotion{.poses = std::vector<BodyPose>(static_cast<std::size_t>(4 * rate_hz), ArmsRaised(0, 0))});
    stream.rate_hz = rate_hz;
    EXPECT_EQ(DescribeStream(stream, PoseParts::kJoints).size(), 60u) << rate_hz;
    const std::size_t half = stream.frames.size() / 2;
    for (std::size_t k = half; k < stream.frames.size(); ++k) stream.frames[k].body_seen = false;
    EXPECT_NEAR(static_cast<double>(DescribeStream(stream, PoseParts::kJoints).size()), 30, 1) << rate_hz;
  }
}

TEST(StepDescriber, AStepIsTheMeanOfItsFrames) {
  BodyMotion motion;
  for (int k = 0; k < 60; ++k) motion.poses.push_back(ArmsRaised(k % 2 == 0 ? 0.2 : 0.6, 0));
  const glm::dvec3 wanted = 0.5 * (ArmsRaised(0.2, 0)[Role::kLeftWrist] + ArmsRaised(0.6, 0)[Role::kLeftWrist]) -
                            ArmsRaised(0, 0)[Role::kHipCentre];
  for (const PoseVector& step : DescribeStream(StreamOf(motion), PoseParts::kJoints)) {
    EXPECT_LT(glm::distance(step.parts[kLeftWristPart], wanted), 1e-9);
  }
}

}  // namespace
}  // namespace etude
