#include "engine/switching/joins/inertialise.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// The smallest rotation from one direction to another as axis × angle; zero vectors do not turn.
glm::dvec3 RotationBetween(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 normal = glm::cross(from, to);
  const double length = glm::length(normal);
  const double angle = AngleBetween(from, to);
  if (length > 0) return normal * (angle / length);
  if (angle == 0) return glm::dvec3(0);
  // Opposite directions: any axis across will do, as long as it is always the same one.
  const glm::dvec3 helper = std::abs(from.y) < std::abs(from.x) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(from, helper)) * angle;
}

glm::dvec3 Rotate(const glm::dvec3& rotation, const glm::dvec3& v) {
  const double angle = glm::length(rotation);
  return angle > 0 ? glm::angleAxis(angle, rotation / angle) * v : v;
}

glm::dvec3 Limb(const BodyPose& pose, const Bone& bone) { return pose[bone.child] - pose[bone.parent]; }

}  // namespace

glm::dvec3 Inertialiser::Decay::At(double seconds, double half_life) const {
  // Holden, "Spring-It-On": the damping that halves an offset in about this time.
  const double y = 2.0 * std::numbers::ln2 / half_life;
  return std::exp(-y * seconds) * (offset + (velocity + y * offset) * seconds);
}

Inertialiser::Inertialiser(const PosePair& shown, const PosePair& target, double rate_hz, double half_life)
    : half_life_(half_life) {
  const auto make = [&](const glm::dvec3& before, const glm::dvec3& now) {
    return Decay{now, (now - before) * rate_hz};
  };
  hips_ = make(shown.before[Role::kHipCentre] - target.before[Role::kHipCentre],
               shown.now[Role::kHipCentre] - target.now[Role::kHipCentre]);
  for (const Bone& bone : AllBones()) {
    const glm::dvec3 before = RotationBetween(Limb(target.before, bone), Limb(shown.before, bone));
    const glm::dvec3 now = RotationBetween(Limb(target.now, bone), Limb(shown.now, bone));
    // Near a half turn the axis may flip between two frames; that is no velocity.
    const bool flipped = glm::dot(before, now) < 0 && glm::length(now) > 0.5 * kPi;
    limbs_[Index(bone.child)] = make(flipped ? now : before, now);
  }
}

BodyPose Inertialiser::Apply(const BodyPose& target, double seconds) const {
  BodyPose pose;
  pose[Role::kHipCentre] = target[Role::kHipCentre] + hips_.At(seconds, half_life_);
  for (const Bone& bone : AllBones()) {
    const glm::dvec3 rotation = limbs_[Index(bone.child)].At(seconds, half_life_);
    pose[bone.child] = pose[bone.parent] + Rotate(rotation, Limb(target, bone));
  }
  return pose;
}

Blend InertialiseSpring(const Meeting& meeting, const JoinSettings& settings) {
  const Inertialiser offsets(meeting.shown, meeting.target, meeting.rate_hz, settings.half_life_s);
  return [offsets, rate_hz = meeting.rate_hz](const BodyPose& target, int frames) {
    return offsets.Apply(target, frames / rate_hz);
  };
}

}  // namespace etude
