#include "bench/metrics/pose_error.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace etude {
namespace {

constexpr double kMmPerMetre = 1000;

glm::dvec3 MeanOf(std::span<const glm::dvec3> points) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

glm::dmat3 ToGlm(const Eigen::Matrix3d& m) {
  glm::dmat3 result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result[column][row] = m(row, column);
  }
  return result;
}

}  // namespace

Similarity AlignSimilarity(std::span<const glm::dvec3> points, std::span<const glm::dvec3> targets) {
  assert(points.size() == targets.size() && !points.empty());
  const glm::dvec3 mean = MeanOf(points), target_mean = MeanOf(targets);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double scatter = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 p = points[i] - mean, t = targets[i] - target_mean;
    covariance += Eigen::Vector3d(t.x, t.y, t.z) * Eigen::RowVector3d(p.x, p.y, p.z);
    scatter += glm::dot(p, p);
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The guard: a mirrored body must not count as a good one, so the last axis turns round instead.
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Vector3d signs(1, 1, sign);
  Similarity similarity;
  similarity.rotation = ToGlm(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose());
  if (scatter > 0) similarity.scale = svd.singularValues().dot(signs) / scatter;
  similarity.translation = target_mean - similarity.scale * (similarity.rotation * mean);
  return similarity;
}

double FrameMpjpeMm(const BodyPose& found, const BodyPose& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) sum += glm::distance(found.joints[i], truth.joints[i]);
  return kMmPerMetre * sum / static_cast<double>(kRoleCount);
}

double FramePaMpjpeMm(const BodyPose& found, const BodyPose& truth) {
  const Similarity similarity = AlignSimilarity(found.joints, truth.joints);
  BodyPose aligned;
  for (std::size_t i = 0; i < kRoleCount; ++i) aligned.joints[i] = similarity.Apply(found.joints[i]);
  return FrameMpjpeMm(aligned, truth);
}

PoseErrors ComparePoses(std::span<const BodyPose> found, std::span<const BodyPose> truth) {
  assert(found.size() == truth.size() && !found.empty());
  constexpr double kNear_mm = 50, kAucEnd_mm = 200, kCmPerMetre = 100;
  PoseErrors sums;
  for (std::size_t f = 0; f < found.size(); ++f) {
    sums.frame_mpjpe_mm.push_back(FrameMpjpeMm(found[f], truth[f]));
    sums.mpjpe_mm += sums.frame_mpjpe_mm.back();
    sums.pa_mpjpe_mm += FramePaMpjpeMm(found[f], truth[f]);
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const double error_mm = kMmPerMetre * glm::distance(found[f].joints[i], truth[f].joints[i]);
      sums.pck_50mm += error_mm < kNear_mm;
      // The area under a step at `error_mm` is what lies right of it.
      sums.auc_200mm += std::max(0.0, 1 - error_mm / kAucEnd_mm);
    }
    for (const Bone& bone : AllBones()) {
      sums.bone_length_error_cm += kCmPerMetre * std::abs(BoneLength(found[f], bone) - BoneLength(truth[f], bone));
    }
  }
  const auto frames = static_cast<double>(found.size());
  const double joints = frames * static_cast<double>(kRoleCount);
  PoseErrors means = std::move(sums);
  means.mpjpe_mm /= frames;
  means.pa_mpjpe_mm /= frames;
  means.pck_50mm /= joints;
  means.auc_200mm /= joints;
  means.bone_length_error_cm /= frames * static_cast<double>(AllBones().size());
  return means;
}

}  // namespace etude
