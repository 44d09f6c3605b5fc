#include "engine/keypoints/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/cameras/robust_triangulation.h"
#include "engine/capture/fit_pose.h"
#include "engine/keypoints/recover_person.h"
#include "sim/choreography/canonical_body.h"
#include "sim/random/stream.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr std::pair<Landmark, Role> kSeen[] = {{Landmark::kHead, Role::kHead},
                                               {Landmark::kLeftShoulder, Role::kLeftShoulder},
                                               {Landmark::kLeftElbow, Role::kLeftElbow},
                                               {Landmark::kLeftWrist, Role::kLeftWrist},
                                               {Landmark::kLeftHand, Role::kLeftHand},
                                               {Landmark::kRightShoulder, Role::kRightShoulder},
                                               {Landmark::kRightElbow, Role::kRightElbow},
                                               {Landmark::kRightWrist, Role::kRightWrist},
                                               {Landmark::kRightHand, Role::kRightHand},
                                               {Landmark::kLeftHip, Role::kLeftHip},
                                               {Landmark::kLeftKnee, Role::kLeftKnee},
                                               {Landmark::kLeftAnkle, Role::kLeftAnkle},
                                               {Landmark::kLeftBigToe, Role::kLeftFoot},
                                               {Landmark::kRightHip, Role::kRightHip},
                                               {Landmark::kRightKnee, Role::kRightKnee},
                                               {Landmark::kRightAnkle, Role::kRightAnkle},
                                               {Landmark::kRightBigToe, Role::kRightFoot}};

std::vector<Camera> Rig(int count) {
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i) {
    const double angle = -0.7 + 1.4 * i;
    const Intrinsics in{.width = 1280, .height = 960, .fx = 700, .fy = 700, .cx = 640, .cy = 480};
    cameras.push_back(LookAt(in, {4 * std::sin(angle), 1.0 + 0.6 * i, 4 * std::cos(angle)}, {0, 0.9, 0}));
  }
  return cameras;
}

/// Returns the standing pose with trunk joints as `JointsOf` places them.
BodyPose Standing() {
  BodyPose pose = PoseOf(ReadyStance());
  pose[Role::kHipCentre] = 0.5 * (pose[Role::kLeftHip] + pose[Role::kRightHip]);
  pose[Role::kShoulderCentre] = 0.5 * (pose[Role::kLeftShoulder] + pose[Role::kRightShoulder]);
  pose[Role::kSpine] = glm::mix(pose[Role::kHipCentre], pose[Role::kShoulderCentre], kSpineShare);
  return pose;
}

double Turn(const BodyPose& a, const BodyPose& b, const Bone& bone) {
  const glm::dvec3 u = glm::normalize(a[bone.child] - a[bone.parent]),
                   v = glm::normalize(b[bone.child] - b[bone.parent]);
  return 2 * std::asin(std::min(1.0, glm::length(u - v) / 2));
}

/// Compares the forecast with keypoints that are simulated, triangulated and fitted.
void Compare(int cameras_count, const SightingErrors& errors, int trial) {
  const std::vector<Camera> cameras = Rig(cameras_count);
  const BodyPose pose = Standing();
  ASSERT_OK(forecast, PoseErrorForecast::Of(pose));
  ASSERT_OK(expected, forecast->At(cameras, glm::dvec3(0), errors));
  std::array<double, kRoleCount> lengths{};
  for (const Bone& bone : AllBones()) lengths[Index(bone.child)] = BoneLength(pose, bone);
  const CaptureBody body = BodyOfBones(lengths).value();
  RandomStream dice({Seed{1}, "pose-error", trial}, "draws");
  constexpr int kDraws = 600;
  std::array<JointErrors, kRoleCount> sums{};
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Camera> believed = cameras;
    for (Camera& camera : believed) camera.p_WC += errors.calibration.place_m * dice.Normal3();
    LandmarkPositions landmarks;
    for (const auto& [landmark, role] : kSeen) {
      std::vector<InformedSighting> sightings;
      for (std::size_t i = 0; i < cameras.size(); ++i) {
        const glm::dvec2 noise = errors.noise_px * glm::dvec2(dice.Normal(), dice.Normal());
        sightings.push_back({{MatrixOf(believed[i]), *Project(cameras[i], pose[role]) + noise}});
      }
      landmarks[Index(landmark)] = TriangulateLikeliest(sightings)->position;
    }
    const RoleVectors joints = JointsOf(landmarks);
    BodyPose points = pose;
    for (const Role role : AllRoles()) {
      if (joints[Index(role)]) points[role] = *joints[Index(role)];
    }
    points[Role::kSpine] = glm::mix(points[Role::kHipCentre], points[Role::kShoulderCentre], kSpineShare);
    const BodyPose fitted = ToBodyPose(body, FitPerson(body, {&landmarks, 1}).front().value());
    for (const Role role : AllRoles()) {
      const glm::dvec3 off = points[role] - pose[role], in_body = fitted[role] - pose[role];
      sums[Index(role)].point += glm::dot(off, off) / kDraws;
      sums[Index(role)].body += glm::dot(in_body, in_body) / kDraws;
    }
    for (const Bone& bone : AllBones()) {
      sums[Index(bone.child)].point_turn += std::pow(Turn(points, pose, bone), 2) / kDraws;
      sums[Index(bone.child)].body_turn += std::pow(Turn(fitted, pose, bone), 2) / kDraws;
    }
  }
  for (const Role role : AllRoles()) {
    const JointErrors &one = (*expected)[Index(role)], &other = sums[Index(role)];
    EXPECT_NEAR(std::sqrt(one.point / other.point), 1, 0.15) << RoleName(role);
    EXPECT_NEAR(std::sqrt(one.body / other.body), 1, 0.15) << RoleName(role);
    if (role == Role::kHipCentre) continue;
    EXPECT_NEAR(std::sqrt(one.point_turn / other.point_turn), 1, 0.15) << RoleName(role);
    EXPECT_NEAR(std::sqrt(one.body_turn / other.body_turn), 1, 0.15) << RoleName(role);
  }
}

TEST(PoseErrorForecast, IsThatOfFittedBodies) {
  Compare(2, {.noise_px = 1}, 0);
  Compare(3, {.noise_px = 2}, 1);
}

TEST(PoseErrorForecast, KnowsThatACalibrationErrsAlikeForAllJoints) {
  Compare(3, {.noise_px = 0.5, .calibration = {.place_m = 0.004}}, 2);
}

TEST(PoseErrorForecast, SaysThatABodyHelps) {
  const auto forecast = PoseErrorForecast::Of(Standing()).value();
  const auto errors = forecast.At(Rig(3), glm::dvec3(0), {.noise_px = 2}).value();
  double points = 0, body = 0;
  for (const JointErrors& joint : errors) {
    points += joint.point;
    body += joint.body;
  }
  EXPECT_LT(body, 0.9 * points);
  EXPECT_FALSE(forecast.At(Rig(3), {9, 0, 0}, {.noise_px = 2})) << "outside of the pictures";
}

TEST(PoseErrorForecast, TakesTheNoiseOfEachJoint) {
  const auto forecast = PoseErrorForecast::Of(Standing()).value();
  std::array<double, kRoleCount> noise_px;
  noise_px.fill(2);
  const auto same = forecast.At(Rig(3), glm::dvec3(0), {.noise_px = 2}).value();
  const auto each = forecast.At(Rig(3), glm::dvec3(0), {.noise_px = 9}, noise_px).value();
  for (std::size_t i = 0; i < kRoleCount; ++i) EXPECT_EQ(each[i].body, same[i].body);
  noise_px[Index(Role::kLeftWrist)] = 4;
  const auto worse = forecast.At(Rig(3), glm::dvec3(0), {}, noise_px).value();
  EXPECT_NEAR(worse[Index(Role::kLeftWrist)].point / same[Index(Role::kLeftWrist)].point, 4, 1e-9);
  EXPECT_EQ(worse[Index(Role::kLeftElbow)].point, same[Index(Role::kLeftElbow)].point);
  EXPECT_GT(worse[Index(Role::kLeftElbow)].body, same[Index(Role::kLeftElbow)].body);
}

}  // namespace
}  // namespace etude
