#include "engine/keypoints/pose_error.h"

#include <Eigen/Dense>

#include "engine/capture/fit_pose.h"
#include "engine/keypoints/recover_person.h"
#include "engine/kinematics/capture_body.h"

namespace etude {
namespace {

constexpr int kNumbers = 3 * kRoleCount;
using Square = Eigen::Matrix<double, kNumbers, kNumbers>;

int RowOf(Role role) { return 3 * static_cast<int>(role); }

/// Returns the linear map from the errors of the triangulated joints to the errors of all joints.
Square PointsMap() {
  Square map = Square::Identity();
  const auto compose = [&](Role role, Role a, double share_of_a, Role b) {
    const Eigen::Matrix<double, 3, kNumbers> rows =
        share_of_a * map.middleRows<3>(RowOf(a)) + (1 - share_of_a) * map.middleRows<3>(RowOf(b));
    map.middleRows<3>(RowOf(role)) = rows;
  };
  compose(Role::kHipCentre, Role::kLeftHip, 0.5, Role::kRightHip);
  compose(Role::kShoulderCentre, Role::kLeftShoulder, 0.5, Role::kRightShoulder);
  compose(Role::kSpine, Role::kShoulderCentre, kSpineShare, Role::kHipCentre);
  return map;
}

/// Returns the derivatives of the twenty joints with respect to the root's position and all angles, 60 × (3 + angles).
Eigen::MatrixXd JointDerivatives(const CaptureBody& body, const TreeState& state) {
  const TreeFrames frames = ComputeFrames(body.tree, state);
  const BodyPose pose = ToBodyPose(body, frames);
  Eigen::MatrixXd derivatives = Eigen::MatrixXd::Zero(kNumbers, 3 + body.tree.dof_count());
  for (const Role role : AllRoles()) {
    derivatives.block<3, 3>(RowOf(role), 0).setIdentity();
    for (int j = body.roles[Index(role)].joint; j >= 0; j = body.tree.joints[j].parent) {
      const TreeJoint& joint = body.tree.joints[j];
      for (int dof = joint.first_dof; dof < joint.first_dof + joint.dof_count; ++dof) {
        const glm::dvec3 moved = glm::cross(frames.dof_axes[dof], pose[role] - frames.joints[j].position);
        derivatives.block<3, 1>(RowOf(role), 3 + dof) << moved.x, moved.y, moved.z;
      }
    }
  }
  return derivatives;
}

/// The mean square errors of one joint's position, m², and of its limb's direction, rad².
struct Squares {
  double place = 0, turn = 0;
};

Squares SquaresOf(const Square& covariance, const BodyPose& pose, Role role) {
  const auto block = [&](Role a, Role b) { return covariance.block<3, 3>(RowOf(a), RowOf(b)); };
  Squares squares{.place = block(role, role).trace()};
  if (const auto parent = ParentOf(role)) {
    const glm::dvec3 limb = pose[role] - pose[*parent];
    const double length = glm::length(limb);
    const Eigen::Vector3d along(limb.x / length, limb.y / length, limb.z / length);
    const Eigen::Matrix3d between =
        block(role, role) + block(*parent, *parent) - block(role, *parent) - block(*parent, role);
    squares.turn = (between.trace() - along.dot(between * along)) / (length * length);
  }
  return squares;
}

}  // namespace

bool IsTriangulated(Role role) {
  return role != Role::kHipCentre && role != Role::kSpine && role != Role::kShoulderCentre;
}

Result<PoseErrorForecast> PoseErrorForecast::Of(const BodyPose& pose) {
  std::array<double, kRoleCount> lengths{};
  for (const Bone& bone : AllBones()) lengths[Index(bone.child)] = BoneLength(pose, bone);
  ASSIGN_OR_RETURN(const CaptureBody body, BodyOfBones(lengths));
  const auto fit = PoseFitter(body).Fit(TargetsAt(pose));
  if (!fit) return Fail({}, "the pose is not finite");
  // Compute an orthonormal basis of the joint displacements that the body allows (QR with column pivoting).
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> basis(JointDerivatives(body, fit->state));
  const Eigen::MatrixXd reachable =
      basis.householderQ() * Eigen::MatrixXd::Identity(kNumbers, static_cast<Eigen::Index>(basis.rank()));
  const Square to_points = PointsMap(), to_body = reachable * (reachable.transpose() * to_points);
  PoseErrorForecast forecast;
  forecast.pose_ = pose;
  forecast.to_points_.assign(to_points.data(), to_points.data() + to_points.size());
  forecast.to_body_.assign(to_body.data(), to_body.data() + to_body.size());
  return forecast;
}

std::optional<std::array<JointErrors, kRoleCount>> PoseErrorForecast::At(std::span<const Camera> cameras,
                                                                         const glm::dvec3& shift, SightingErrors errors,
                                                                         std::span<const double> noise_px) const {
  // Split the covariance into a part that all joints share (calibration) and a part of each joint alone (noise).
  Eigen::MatrixXd common =
      Eigen::MatrixXd::Zero(kNumbers, static_cast<Eigen::Index>(kCalibrationParameters * cameras.size()));
  Square own = Square::Zero();
  for (const Role role : AllRoles()) {
    if (!IsTriangulated(role)) continue;
    if (!noise_px.empty()) errors.noise_px = noise_px[Index(role)];
    const PointError error = ExpectedPointError(cameras, pose_[role] + shift, errors);
    if (error.lost >= 1) return std::nullopt;
    const int row = RowOf(role);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      for (std::size_t k = 0; k < kCalibrationParameters; ++k) {
        const glm::dvec3& moved = error.displacements[i][k];
        common.block<3, 1>(row, static_cast<Eigen::Index>(kCalibrationParameters * i + k)) << moved.x, moved.y, moved.z;
      }
    }
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) own(row + r, row + c) = error.covariance[c][r];
    }
    own.block<3, 3>(row, row) -= common.middleRows<3>(row) * common.middleRows<3>(row).transpose();
  }
  // Map the covariance to the errors of all joints, triangulated and in the fitted body.
  const Square covariance = own + common * common.transpose();
  const Eigen::Map<const Square> to_points(to_points_.data()), to_body(to_body_.data());
  const Square points = to_points * covariance * to_points.transpose();
  const Square body = to_body * covariance * to_body.transpose();
  std::array<JointErrors, kRoleCount> joints;
  for (const Role role : AllRoles()) {
    const Squares by_points = SquaresOf(points, pose_, role), by_body = SquaresOf(body, pose_, role);
    joints[Index(role)] = {by_points.place, by_body.place, by_points.turn, by_body.turn};
  }
  return joints;
}

}  // namespace etude
