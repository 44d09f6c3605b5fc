#include "engine/retargeting/orientation.h"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/motion/statistics.h"
#include "engine/retargeting/leg_sides.h"

namespace etude {
namespace {

using enum Role;

glm::dvec3 Direction(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

glm::dvec3 Across(const BodyPose& pose, Role left, Role right) { return Direction(pose[left] - pose[right]); }

/// Returns the direction in which chest and belly face.
glm::dvec3 Forward(const BodyPose& pose) {
  return Direction(glm::cross(Across(pose, kLeftHip, kRightHip), Direction(pose[kShoulderCentre] - pose[kHipCentre])));
}

double LimbLength(const BodyPose& pose, Role upper, Role middle, Role end) {
  return glm::distance(pose[upper], pose[middle]) + glm::distance(pose[middle], pose[end]);
}

/// Returns the vector from the midpoint of a limb's two ends to the limb's middle joint, divided by the limb's length.
glm::dvec3 BendOffset(const BodyPose& pose, Role upper, Role middle, Role end) {
  const double length = LimbLength(pose, upper, middle, end);
  return length > 0 ? (pose[middle] - 0.5 * (pose[upper] + pose[end])) / length : glm::dvec3(0);
}

/// Returns the vector from a limb's beginning to its end, relative to the limb's length.
glm::dvec3 Reach(const BodyPose& pose, Role upper, Role middle, Role end) {
  const double length = LimbLength(pose, upper, middle, end);
  return length > 0 ? (pose[end] - pose[upper]) / length : glm::dvec3(0);
}

/// Returns the bending angle of a knee, radians; negative if the knee points away from the fronts of both trunk and
/// thigh. (The trunk may bend far backwards, and the thigh may turn sideways.)
double KneeBend(const BodyPose& pose, Role hip, Role knee, Role ankle) {
  const double angle = AngleBetween(pose[knee] - pose[hip], pose[ankle] - pose[knee]);
  const glm::dvec3 offset = pose[knee] - 0.5 * (pose[hip] + pose[ankle]);
  const glm::dvec3 front = glm::cross(pose[kLeftHip] - pose[kRightHip], pose[hip] - pose[knee]);
  return glm::dot(Forward(pose), offset) < 0 && glm::dot(front, offset) < 0 ? -angle : angle;
}

/// Evidence that left and right are not exchanged. It is measured in the body's own frame, so the body may lie or turn
/// over.
struct Sides {
  double shoulders = 0, knees = 0, arms = 0;  ///< sums over frames (and limbs); positive if not exchanged
  LegSides legs;
  std::vector<double> knee_bends;  ///< result of KneeBend for left and right knee in each frame
};

Sides MeasureSides(std::span<const BodyPose> poses) {
  Sides sides;
  for (const BodyPose& pose : poses) {
    const glm::dvec3 forward = Forward(pose);
    sides.shoulders += glm::dot(Across(pose, kLeftShoulder, kRightShoulder), Across(pose, kLeftHip, kRightHip));
    for (const auto& [hip, knee, ankle, toe] : {std::tuple(kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot),
                                                std::tuple(kRightHip, kRightKnee, kRightAnkle, kRightFoot)}) {
      sides.legs.Add(pose[kLeftHip] - pose[kRightHip], pose[hip], pose[knee], pose[ankle], pose[toe]);
      sides.knees += glm::dot(forward, BendOffset(pose, hip, knee, ankle));
      sides.knee_bends.push_back(KneeBend(pose, hip, knee, ankle));
    }
    for (const auto& [shoulder, elbow, wrist] :
         {std::tuple(kLeftShoulder, kLeftElbow, kLeftWrist), std::tuple(kRightShoulder, kRightElbow, kRightWrist)}) {
      // Hands are usually in front of the body, and elbows behind the line from shoulder to wrist.
      sides.arms += glm::dot(forward, Reach(pose, shoulder, elbow, wrist) - BendOffset(pose, shoulder, elbow, wrist));
    }
  }
  return sides;
}

}  // namespace

glm::dvec3 Upright(const glm::dvec3& point, UpAxis up) {
  return up == UpAxis::kY ? point : glm::dvec3(point.x, point.z, -point.y);
}

BodyPose Upright(BodyPose pose, UpAxis up) {
  for (glm::dvec3& joint : pose.joints) joint = Upright(joint, up);
  return pose;
}

glm::dvec3 BodyAxis(const BodyPose& pose) {
  const glm::dvec3 axis = pose[kHead] - 0.5 * (pose[kLeftAnkle] + pose[kRightAnkle]);
  const double length = glm::length(axis);
  return length > 0 ? axis / length : glm::dvec3(0);
}

glm::dvec3 MeanBodyAxis(std::span<const BodyPose> poses) {
  glm::dvec3 sum(0);
  for (const BodyPose& pose : poses) sum += BodyAxis(pose);
  return sum / static_cast<double>(poses.size());
}

Result<double> CheckSides(std::span<const BodyPose> poses, const JointMap& map, const std::string& file) {
  const Sides sides = MeasureSides(poses);
  if (sides.shoulders < 0) {
    return Fail({file}, "the left arm is on the side of the right leg, so left and right are exchanged");
  }
  const bool has_feet = std::ranges::find(map.composed, kLeftFoot) == map.composed.end();
  if (const std::string_view backwards = sides.legs.Backwards(); has_feet && !backwards.empty()) {
    return Fail({file}, "{}, so left and right are exchanged, or the axes are left-handed", backwards);
  }
  // Compare each threshold with a mean over limbs and frames.
  const auto count = static_cast<double>(2 * poses.size());
  constexpr double kArmsBackwards = 0.25;
  if (!has_feet && sides.arms < -kArmsBackwards * count) {
    return Fail({file},
                "the arms bend and reach backwards, so left and right are exchanged, or the axes are left-handed");
  }
  constexpr double kMinBendOffset = 0.01, kMaxOverextension = Radians(35);
  const bool are_backwards = LowerPercentile(sides.knee_bends, 0.25) < -kMaxOverextension || sides.arms < 0;
  if (!has_feet && sides.knees < -kMinBendOffset * count && are_backwards) {
    return Fail({file}, "the knees bend backwards, so left and right are exchanged, or the axes are left-handed");
  }
  constexpr double kMinReported = Radians(3);
  double mean = 0;
  for (const double bend : sides.knee_bends) mean -= bend / count;
  return mean >= kMinReported ? mean : 0;
}

Result<void> CheckLimbs(std::span<const BodyPose> poses, const std::string& file) {
  constexpr double kMinPerStature = 0.01;
  const auto median = [&](const auto& measure) {
    std::vector<double> values;
    for (const BodyPose& pose : poses) values.push_back(measure(pose));
    return LowerPercentile(std::move(values), 0.5);
  };
  const double stature = median(Stature);
  std::vector<std::string> gone;
  for (const Bone& bone : ArmAndLegBones()) {
    const double length = median([&](const BodyPose& pose) { return BoneLength(pose, bone); });
    if (length <= kMinPerStature * stature) {
      gone.push_back(fmt::format("{} to {}", RoleName(bone.parent), RoleName(bone.child)));
    }
  }
  if (gone.size() < 2) return {};
  return Fail({file}, "{} of the body's 8 limbs have no length ({}); allowed: limbs of a person's lengths", gone.size(),
              Join(gone));
}

}  // namespace etude
