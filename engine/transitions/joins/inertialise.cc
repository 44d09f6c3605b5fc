#include "engine/transitions/joins/inertialise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/angles.h"
#include "engine/transitions/joins/limb_turn.h"

namespace etude {
namespace {

glm::dvec3 Limb(const BodyPose& pose, const Bone& bone) { return pose[bone.child] - pose[bone.parent]; }

Blend Inertialise(const SeamMotions& motions, DecayLaw law, const JoinSettings& settings) {
  return [inertialiser = Inertialiser(motions, law, settings), rate_hz = motions.rate_hz](
             const BodyPose& target, int frames) { return inertialiser.Apply(target, frames / rate_hz); };
}

}  // namespace

Inertialiser::Inertialiser(const SeamMotions& motions, DecayLaw law, const JoinSettings& settings)
    : law_(law), settings_(settings) {
  const auto& [shown, target, continuation, rate_hz] = motions;
  const auto measure = [rate = rate_hz](const glm::dvec3& before, const glm::dvec3& now) {
    return Offset{now, (now - before) * rate};
  };
  hips_ = measure(shown.before[Role::kHipCentre] - target.before[Role::kHipCentre],
                  shown.now[Role::kHipCentre] - target.now[Role::kHipCentre]);
  for (const Bone& bone : AllBones()) {
    const LimbTurn before = TurnBetween(Limb(target.before, bone), Limb(shown.before, bone));
    const LimbTurn now = TurnBetween(Limb(target.now, bone), Limb(shown.now, bone));
    // Near a half turn the axis may flip between two frames; that is no velocity.
    const bool flipped = glm::dot(before, now) < 0 && glm::length(now) > 0.5 * kPi;
    limbs_[Index(bone.child)] = measure(flipped ? now : before, now);
  }
}

BodyPose Inertialiser::Apply(const BodyPose& target, double seconds) const {
  BodyPose pose;
  pose[Role::kHipCentre] = target[Role::kHipCentre] + law_(hips_, seconds, settings_);
  for (const Bone& bone : AllBones()) {
    const LimbTurn turn = law_(limbs_[Index(bone.child)], seconds, settings_);
    pose[bone.child] = pose[bone.parent] + Turned(Limb(target, bone), turn);
  }
  return pose;
}

glm::dvec3 SpringDecay(const Offset& offset, double seconds, const JoinSettings& settings) {
  const double y = 2.0 * std::numbers::ln2 / settings.half_life_s;
  return std::exp(-y * seconds) * (offset.value + (offset.velocity + y * offset.value) * seconds);
}

glm::dvec3 QuinticDecay(const Offset& offset, double seconds, const JoinSettings& settings) {
  const double x0 = glm::length(offset.value);
  if (x0 == 0) return glm::dvec3(0);
  const glm::dvec3 axis = offset.value / x0;
  const double v0 = std::min(glm::dot(offset.velocity, axis), 0.0);
  // The parabola from x0 with slope v0 to rest would be there at −2 x0/v0; Bollo lets the quintic take 5/2 of that.
  const double t1 = v0 < 0 ? std::min(settings.blend_s, -5 * x0 / v0) : settings.blend_s;
  if (seconds >= t1) return glm::dvec3(0);
  const double a0 = std::max(0.0, (-8 * v0 * t1 - 20 * x0) / (t1 * t1));
  // x(s), s = t/t1, with x(0) = x0, x'(0) = v0, x''(0) = a0 and all three zero at s = 1.
  const double s = seconds / t1, v = v0 * t1, a = a0 * t1 * t1;
  const double c3 = -0.5 * (3 * a + 12 * v + 20 * x0);
  const double c4 = 0.5 * (3 * a + 16 * v + 30 * x0);
  const double c5 = -0.5 * (a + 6 * v + 12 * x0);
  return axis * (x0 + s * (v + s * (0.5 * a + s * (c3 + s * (c4 + s * c5)))));
}

Blend InertialiseSpring(const SeamMotions& motions, const JoinSettings& settings) {
  return Inertialise(motions, SpringDecay, settings);
}

Blend InertialiseQuintic(const SeamMotions& motions, const JoinSettings& settings) {
  return Inertialise(motions, QuinticDecay, settings);
}

}  // namespace etude
