#include "bench/metrics/pose_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/nearest_rotation.h"

namespace etude {
namespace {

constexpr double kMmPerMetre = 1000;

// Returns the sum of the angle errors over all pairs of successive limbs, degrees, and adds the number of pairs to
// `count`.
double AngleErrorsDeg(const BodyPose& found, const BodyPose& truth, int& count) {
  const auto angle = [](const BodyPose& pose, Role grandparent, const Bone& bone) {
    const glm::dvec3 upper = pose[bone.parent] - pose[grandparent], lower = pose[bone.child] - pose[bone.parent];
    return glm::dot(upper, upper) > 0 && glm::dot(lower, lower) > 0 ? Degrees(AngleBetween(upper, lower)) : 0.0;
  };
  double sum = 0;
  for (const Bone& bone : AllBones()) {
    const auto grandparent = ParentOf(bone.parent);
    if (!grandparent) continue;
    sum += std::abs(angle(found, *grandparent, bone) - angle(truth, *grandparent, bone));
    ++count;
  }
  return sum;
}

}  // namespace

void PointMoments::Add(const PointMoments& other) {
  if (other.count == 0) return;
  const double both = count + other.count, weight = count * other.count / both;
  const glm::dvec3 apart = other.mean - mean, targets_apart = other.target_mean - target_mean;
  covariance += other.covariance + weight * glm::outerProduct(targets_apart, apart);
  scatter += other.scatter + weight * glm::dot(apart, apart);
  mean += other.count / both * apart;
  target_mean += other.count / both * targets_apart;
  count = both;
}

PointMoments MomentsOf(std::span<const glm::dvec3> points, std::span<const glm::dvec3> targets) {
  assert(points.size() == targets.size());
  PointMoments moments;
  const auto are_seen = [&](std::size_t i) { return !std::isnan(points[i].x) && !std::isnan(targets[i].x); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!are_seen(i)) continue;
    moments.mean += points[i];
    moments.target_mean += targets[i];
    ++moments.count;
  }
  if (moments.count == 0) return moments;
  moments.mean /= moments.count;
  moments.target_mean /= moments.count;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!are_seen(i)) continue;
    const glm::dvec3 p = points[i] - moments.mean, t = targets[i] - moments.target_mean;
    moments.covariance += glm::outerProduct(t, p);
    moments.scatter += glm::dot(p, p);
  }
  return moments;
}

Similarity AlignSimilarity(const PointMoments& moments) {
  assert(moments.count > 0);
  // A reflection is not allowed; otherwise a mirrored body would have no error.
  const NearestRotation nearest = NearestRotationTo(moments.covariance);
  Similarity similarity;
  similarity.rotation = nearest.rotation;
  const glm::dvec3& values = nearest.signed_singular_values;
  if (moments.scatter > 0) similarity.scale = (values[0] + values[1] + values[2]) / moments.scatter;
  similarity.translation = moments.target_mean - similarity.scale * (similarity.rotation * moments.mean);
  return similarity;
}

Similarity AlignSimilarity(std::span<const glm::dvec3> points, std::span<const glm::dvec3> targets) {
  return AlignSimilarity(MomentsOf(points, targets));
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
  // Sum the errors over all frames, joints and limbs.
  PoseErrors sums;
  int angles = 0;
  for (std::size_t f = 0; f < found.size(); ++f) {
    sums.frame_mpjpe_mm.push_back(FrameMpjpeMm(found[f], truth[f]));
    sums.mpjpe_mm += sums.frame_mpjpe_mm.back();
    sums.pa_mpjpe_mm += FramePaMpjpeMm(found[f], truth[f]);
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const double error_mm = kMmPerMetre * glm::distance(found[f].joints[i], truth[f].joints[i]);
      sums.pck_50mm += error_mm < kNear_mm;
      // The share of correct joints, for a single joint, is 0 at thresholds below `error_mm` and 1 above it. The area
      // under this curve is the part of the range above `error_mm`.
      sums.auc_200mm += std::max(0.0, 1 - error_mm / kAucEnd_mm);
    }
    sums.joint_angle_error_deg += AngleErrorsDeg(found[f], truth[f], angles);
    for (const Bone& bone : AllBones()) {
      sums.bone_length_error_cm += kCmPerMetre * std::abs(BoneLength(found[f], bone) - BoneLength(truth[f], bone));
    }
  }
  // Divide the sums by their counts.
  const auto frames = static_cast<double>(found.size());
  const double joints = frames * static_cast<double>(kRoleCount);
  PoseErrors means = std::move(sums);
  means.mpjpe_mm /= frames;
  means.pa_mpjpe_mm /= frames;
  means.pck_50mm /= joints;
  means.auc_200mm /= joints;
  means.bone_length_error_cm /= frames * static_cast<double>(AllBones().size());
  means.joint_angle_error_deg /= angles;
  return means;
}

std::optional<double> MeanOfFlagged(std::span<const double> values, const std::vector<bool>& flags) {
  assert(values.size() == flags.size());
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!flags[i]) continue;
    sum += values[i];
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::optional<double> JerkErrorMps3(std::span<const BodyPose> found, std::span<const BodyPose> truth,
                                    const std::vector<bool>& judged, double rate_hz) {
  assert(found.size() == truth.size() && judged.size() == truth.size());
  double sum = 0;
  int count = 0;
  for (std::size_t f = 0; f + 3 < found.size(); ++f) {
    if (!judged[f] || !judged[f + 1] || !judged[f + 2] || !judged[f + 3]) continue;
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const auto error = [&](std::size_t k) { return found[f + k].joints[i] - truth[f + k].joints[i]; };
      sum += glm::length(error(3) - 3.0 * error(2) + 3.0 * error(1) - error(0));
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return rate_hz * rate_hz * rate_hz * sum / count;
}

double LimbLengthErrorMm(std::span<const double> found_m, std::span<const double> true_m) {
  assert(found_m.size() == true_m.size() && !found_m.empty());
  double sum = 0;
  for (std::size_t i = 0; i < found_m.size(); ++i) sum += std::abs(found_m[i] - true_m[i]);
  return kMmPerMetre * sum / static_cast<double>(found_m.size());
}

}  // namespace etude
