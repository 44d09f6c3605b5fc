#include "bench/metrics/transition_smoothness.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

constexpr double kCm = 100;  // centimetres in a metre

glm::dvec3 SecondDifference(const BodyMotion& motion, int frame, std::size_t joint) {
  const auto at = [&](int f) -> const glm::dvec3& { return motion.poses[f].joints[joint]; };
  return at(frame + 1) - 2.0 * at(frame) + at(frame - 1);
}

struct Jump {
  double largest = 0, mean = 0;
};

Jump JumpAt(const BodyMotion& motion, int frame) {
  Jump jump;
  for (std::size_t joint = 0; joint < kRoleCount; ++joint) {
    const double length = glm::length(SecondDifference(motion, frame, joint));
    jump.largest = std::max(jump.largest, length);
    jump.mean += length / kRoleCount;
  }
  return jump;
}

/// Returns the smallest rotation that turns one limb direction into the next. Positions do not determine the twist, so
/// it is left out.
glm::dquat StepRotation(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 normal = glm::cross(from, to);
  const double length = glm::length(normal);
  return length > 0 ? glm::angleAxis(AngleBetween(from, to), normal / length) : glm::dquat(1, 0, 0, 0);
}

double RotationAngle(const glm::dquat& q) {
  return 2.0 * std::atan2(glm::length(glm::dvec3(q.x, q.y, q.z)), std::abs(q.w));
}

/// Returns the largest change of any limb's rotation between the step into a frame and the step out of it, radians.
double RotationStepChangeAt(const BodyMotion& motion, int frame) {
  double largest = 0;
  for (const Bone& bone : AllBones()) {
    const auto limb = [&](int f) { return motion.poses[f][bone.child] - motion.poses[f][bone.parent]; };
    const glm::dquat in = StepRotation(limb(frame - 1), limb(frame));
    const glm::dquat out = StepRotation(limb(frame), limb(frame + 1));
    largest = std::max(largest, RotationAngle(out * glm::conjugate(in)));
  }
  return largest;
}

/// Returns the largest third difference of any joint over the frames from frame − 1 to frame + 2.
double ThirdDifferenceAt(const BodyMotion& motion, int frame) {
  double largest = 0;
  for (std::size_t joint = 0; joint < kRoleCount; ++joint) {
    largest = std::max(
        largest, glm::length(SecondDifference(motion, frame + 1, joint) - SecondDifference(motion, frame, joint)));
  }
  return largest;
}

}  // namespace

TransitionSmoothness MeasureTransitions(const BodyMotion& motion, std::span<const int> frames) {
  assert(!frames.empty());
  TransitionSmoothness worst;
  const int count = static_cast<int>(motion.poses.size());
  const double per_s3 = motion.rate_hz * motion.rate_hz * motion.rate_hz;
  for (int point : frames) {
    const int first = std::max(point - kWindowReach, 1), last = std::min(point + kWindowReach, count - 2);
    for (int frame = first; frame <= last; ++frame) {
      const Jump jump = JumpAt(motion, frame);
      worst.jump_cm = std::max(worst.jump_cm, kCm * jump.largest);
      worst.mean_joint_jump_cm = std::max(worst.mean_joint_jump_cm, kCm * jump.mean);
      const double turned = Degrees(RotationStepChangeAt(motion, frame));
      worst.rotation_step_change_deg = std::max(worst.rotation_step_change_deg, turned);
      if (frame + 2 < count) {
        worst.jerk_peak_mps3 = std::max(worst.jerk_peak_mps3, per_s3 * ThirdDifferenceAt(motion, frame));
      }
    }
  }
  return worst;
}

std::vector<double> SecondDifferencesCm(const BodyMotion& motion) {
  std::vector<double> differences(motion.poses.size(), 0.0);
  for (int frame = 1; frame + 1 < static_cast<int>(motion.poses.size()); ++frame) {
    differences[frame] = kCm * JumpAt(motion, frame).largest;
  }
  return differences;
}

std::vector<double> NaturalJumpsCm(const BodyMotion& clip) {
  const std::vector<double> differences = SecondDifferencesCm(clip);
  std::vector<double> jumps;
  // The first frame has no second difference, so the first complete window starts at frame 1.
  constexpr std::size_t kWindow = 2 * kWindowReach + 1;
  for (std::size_t first = 1; first + kWindow < differences.size(); ++first) {
    const auto begin = differences.begin() + static_cast<std::ptrdiff_t>(first);
    jumps.push_back(*std::max_element(begin, begin + kWindow));
  }
  return jumps;
}

double NaturalLimitCm(std::vector<double> natural_jumps) { return Quantile(natural_jumps, 0.95); }

bool IsNatural(std::optional<double> jump_cm, std::vector<double> natural_jumps_cm) {
  // If there is only one natural jump, it is the limit. Without a tolerance, rounding could then make the motion with
  // this jump exceed its own limit.
  constexpr double kSlack = 1 + 1e-9;
  return jump_cm && *jump_cm <= kSlack * NaturalLimitCm(std::move(natural_jumps_cm));
}

double FootSlideCmps(const BodyMotion& motion, int point) {
  return FootSlideCmps(motion.poses, point, point + static_cast<int>(motion.rate_hz), motion.rate_hz);
}

double FootSlideCmps(std::span<const BodyPose> poses, int first, int last, double rate_hz) {
  assert(first + 1 < static_cast<int>(poses.size()));
  constexpr double kHeight = 0.025;  // metres: a foot at this height or above does not count
  const int end = std::min(last, static_cast<int>(poses.size()) - 1);
  double sum = 0;
  int samples = 0;
  for (int frame = first; frame < end; ++frame) {
    for (Role foot : {Role::kLeftFoot, Role::kRightFoot}) {
      const glm::dvec3& here = poses[frame][foot];
      const glm::dvec3 step = poses[frame + 1][foot] - here;
      const double speed = kCm * rate_hz * std::sqrt(step.x * step.x + step.z * step.z);
      sum += speed * std::clamp(2.0 - std::exp2(here.y / kHeight), 0.0, 1.0);
      ++samples;
    }
  }
  return sum / samples;
}

double PoseGapCm(const BodyPose& leaving, const BodyPose& arriving) {
  double worst = 0;
  for (Role role : AllRoles()) worst = std::max(worst, glm::distance(leaving[role], arriving[role]));
  return kCm * worst;
}

double VelocityGapCmps(const BodyPose& leaving_before, const BodyPose& leaving, const BodyPose& arriving,
                       const BodyPose& arriving_after, double rate_hz) {
  double worst = 0;
  for (Role role : AllRoles()) {
    const glm::dvec3 old_step = leaving[role] - leaving_before[role];
    const glm::dvec3 new_step = arriving_after[role] - arriving[role];
    worst = std::max(worst, glm::distance(old_step, new_step));
  }
  return kCm * rate_hz * worst;
}

double WaitSeconds(std::span<const Stay> stays, double rate_hz) {
  double seconds = 0;
  for (const Stay& stay : stays) seconds += (stay.until_frame - stay.from_frame) / rate_hz;
  return seconds;
}

}  // namespace etude
