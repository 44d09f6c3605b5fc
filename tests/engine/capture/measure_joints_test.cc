#include "engine/capture/measure_joints.h"

#include <gtest/gtest.h>

#include "engine/kinematics/limb_lengths.h"
#include "tests/engine/capture/marked_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

std::vector<BodyPose> Poses(int count, double step = 0.02) {
  std::vector<BodyPose> poses;
  for (int k = 0; k < count; ++k) poses.push_back(ModelPose(step * k));
  return poses;
}

bool IsMarkedRole(Role role) { return role != Role::kHipCentre && role != Role::kSpine; }

void Hide(Role role, std::size_t frame, std::initializer_list<std::size_t> cameras, TakeMarks& marks) {
  for (const std::size_t camera : cameras) {
    Marks& of_frame = marks[camera][frame];
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      if (StrokeMarks()[i].from == role || StrokeMarks()[i].to == role) of_frame.strokes[i].reset();
    }
    for (std::size_t i = 0; i < kEffectorCount; ++i) {
      if (EffectorMarks()[i].role == role) of_frame.effectors[i].reset();
    }
  }
}

TEST(MarkedJointsOf, SharesTheInformationOfOneThrowAmongTheMarksOfAJoint) {
  const Marks marks = ExactMarks(ModelPose(), CameraAt(-40, 1));
  const auto joints = MarkedJointsOf(marks, {.mark_error_px = 2, .slide_share = 0});
  std::array<glm::dmat2, kRoleCount> sum{};
  for (const MarkedJoint& joint : joints) sum[Index(joint.role)] += joint.information;
  for (const Role role : AllRoles()) {
    if (!IsMarkedRole(role)) continue;
    EXPECT_NEAR(sum[Index(role)][0][0], 0.25, 1e-12) << RoleName(role);
    EXPECT_NEAR(sum[Index(role)][1][1], 0.25, 1e-12) << RoleName(role);
  }
}

TEST(MarkedJointsOf, IsLessSureAlongAStrokeThanAcrossIt) {
  Marks marks;
  marks.strokes[0] = PixelSegment{{100, 100}, {130, 140}};  // 50 px long
  const auto joints = MarkedJointsOf(marks, {.mark_error_px = 2, .slide_share = 0.1});
  ASSERT_EQ(joints.size(), 2u);
  const glm::dvec2 along(0.6, 0.8), across(-0.8, 0.6);
  EXPECT_NEAR(glm::dot(along, joints[0].information * along), 1 / (2. * 2 + 5 * 5), 1e-12);
  EXPECT_NEAR(glm::dot(across, joints[0].information * across), 0.25, 1e-12);
}

TEST(MarkedJointsOf, TakesADiscForTheEndOfItsStroke) {
  Marks marks = ExactMarks(ModelPose(), CameraAt(-40, 1));
  const auto tips = [&] {
    int count = 0;
    for (const MarkedJoint& joint : MarkedJointsOf(marks, {})) count += joint.role == Role::kLeftHand;
    return count;
  };
  EXPECT_EQ(tips(), 1);
  for (auto& disc : marks.effectors) disc.reset();
  EXPECT_EQ(tips(), 1) << "without a disc the stroke tells";
}

TEST(MeasureJoints, FindsEveryJointOfExactMarks) {
  const auto cameras = ThreeCameras();
  const auto poses = Poses(2);
  const auto marks = ExactMarks(poses, cameras);
  const auto measured = MeasureJoints({.cameras = cameras, .marks = marks});
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (const Role role : AllRoles()) {
      EXPECT_EQ(measured[k].is_triangulated[Index(role)], IsMarkedRole(role)) << RoleName(role);
      if (!IsMarkedRole(role)) continue;
      EXPECT_LT(glm::distance(measured[k].joints[Index(role)].position, poses[k][role]), 1e-9) << RoleName(role);
    }
    ASSERT_OK(pose, CompleteJoints(InterpolateJoints(measured)[k], ModelPose()));
    for (const Role role : AllRoles()) EXPECT_LT(glm::distance((*pose)[role], poses[k][role]), 1e-9) << RoleName(role);
  }
}

// The inverse of the reported information is the covariance of the marks' effects.
TEST(MeasureJoints, KnowsHowExactItIs) {
  const std::vector<ProjectionMatrix> cameras = {CameraAt(-40, 1), CameraAt(40, 2.2)};
  const Role role = Role::kLeftHand;  // this role has only disc marks
  constexpr int kTakes = 4000;
  const BodyPose pose = ModelPose();
  auto marks = ExactMarks(std::vector<BodyPose>(kTakes, pose), cameras);
  // Numbers of unit variance: stratified sums of uniform numbers, independent of any library.
  std::uint64_t state = 1;
  const auto normal = [&] {
    double sum = 0;
    for (int i = 0; i < 12; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      sum += static_cast<double>(state >> 11) / 9007199254740992.0;
    }
    return sum - 6;
  };
  for (auto& of_camera : marks) {
    for (Marks& frame : of_camera) {
      for (std::size_t i = 0; i < kEffectorCount; ++i) *frame.effectors[i] += 2.0 * glm::dvec2(normal(), normal());
    }
  }
  const auto measured = MeasureJoints({.cameras = cameras, .marks = marks}, {.mark_error_px = 2});
  double squares = 0;
  for (const JointMeasurements& frame : measured) {
    const PointMeasurement& hand = frame.joints[Index(role)];
    const glm::dvec3 error = hand.position - pose[role];
    squares += glm::dot(error, hand.information * error);
  }
  EXPECT_NEAR(squares / kTakes, 3, 0.15) << "three degrees of freedom";
}

TEST(MeasureJoints, PutsAJointThatOnePictureShowsOnItsLineOfSight) {
  const std::vector<ProjectionMatrix> cameras = {CameraAt(-40, 1), CameraAt(40, 2.2)};
  const auto poses = Poses(5);
  auto marks = ExactMarks(poses, cameras);
  Hide(Role::kRightElbow, 2, {1}, marks);
  Hide(Role::kLeftKnee, 3, {0, 1}, marks);
  const auto measured = MeasureJoints({.cameras = cameras, .marks = marks});
  const PointMeasurement& elbow = measured[2].joints[Index(Role::kRightElbow)];
  EXPECT_FALSE(measured[2].is_triangulated[Index(Role::kRightElbow)]);
  EXPECT_LT(glm::distance(*Project(cameras[0], elbow.position), *Project(cameras[0], poses[2][Role::kRightElbow])),
            1e-6);
  EXPECT_LT(glm::distance(elbow.position, poses[2][Role::kRightElbow]), 0.01);
  EXPECT_EQ(measured[3].joints[Index(Role::kLeftKnee)].information, glm::dmat3(0));
  for (const auto& joints : {InterpolateJoints(measured), SmoothJoints(measured, 30)}) {
    EXPECT_LT(glm::distance(*joints[3][Index(Role::kLeftKnee)], poses[3][Role::kLeftKnee]), 0.01);
  }
}

TEST(CompleteJoints, HangsWhatWasNeverSeenOnWhatWas) {
  const BodyPose pose = ModelPose();
  OptionalJoints joints;
  EXPECT_FALSE(CompleteJoints(joints, pose));
  joints[Index(Role::kLeftHip)] = pose[Role::kLeftHip] + glm::dvec3(1, 2, 3);
  ASSERT_OK(shifted, CompleteJoints(joints, pose));
  for (const Role role : AllRoles()) {
    EXPECT_LT(glm::distance((*shifted)[role], pose[role] + glm::dvec3(1, 2, 3)), 1e-9) << RoleName(role);
  }
  // Both hips are turned by 90°, so the rest follows.
  const FloorMove turn{.yaw = kPi / 2};
  for (const Role role : {Role::kLeftHip, Role::kRightHip}) joints[Index(role)] = turn.Apply(pose)[role];
  ASSERT_OK(turned, CompleteJoints(joints, pose));
  EXPECT_LT(glm::distance((*turned)[Role::kHead], turn.Apply(pose)[Role::kHead]), 0.1);
}

TEST(SmoothPoses, StillsTremblingAndFillsGaps) {
  const std::vector<ProjectionMatrix> cameras = {CameraAt(-40, 1), CameraAt(40, 2.2)};
  const auto poses = Poses(40);
  const auto marks = ExactMarks(poses, cameras);
  const auto measured = MeasureJoints({.cameras = cameras, .marks = marks});
  std::vector<std::optional<BodyPose>> trembling;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    trembling.emplace_back(poses[k]);
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      trembling.back()->joints[i] += 0.015 * glm::dvec3(std::sin(97.0 * static_cast<double>(k * k + i)),
                                                        std::cos(89.0 * static_cast<double>(k * k + 2 * i)), 0);
    }
  }
  trembling[20].reset();
  const auto smooth = SmoothPoses(trembling, measured, 30);
  double before = 0, after = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (const Role role : AllRoles()) {
      if (trembling[k]) before += glm::distance((*trembling[k])[role], poses[k][role]);
      after += glm::distance(smooth[k][role], poses[k][role]);
    }
  }
  EXPECT_LT(after, 0.6 * before);
  EXPECT_LT(glm::distance(smooth[20][Role::kHead], poses[20][Role::kHead]), 0.02);
}

}  // namespace
}  // namespace etude
