#include "engine/transitions/joins/inertialise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "engine/transitions/joins/crossfade.h"
#include "engine/transitions/joins/limbs.h"

namespace etude {
namespace {

glm::dvec3 Limb(const BodyPose& pose, const Bone& bone) { return pose[bone.child] - pose[bone.parent]; }

template <auto Decay, typename Options>
Blend Inertialise(const JoinInput& input, const Options& options) {
  const DecayLaw law = [options](const Offset& offset, double seconds) { return Decay(offset, seconds, options); };
  return [inertialiser = Inertialiser(input, law), rate_hz = input.rate_hz](const BodyPose& target, int frames) {
    return inertialiser.Apply(target, frames / rate_hz);
  };
}

}  // namespace

Inertialiser::Inertialiser(const JoinInput& input, DecayLaw law) : law_(std::move(law)) {
  const PosePair &shown = input.shown, &target = input.target;
  const auto measure = [rate = input.rate_hz](const glm::dvec3& before, const glm::dvec3& now) {
    return Offset{now, (now - before) * rate};
  };
  hips_ = measure(shown.before[Role::kHipCentre] - target.before[Role::kHipCentre],
                  shown.now[Role::kHipCentre] - target.now[Role::kHipCentre]);
  for (const Bone& bone : AllBones()) {
    const LimbTurn before = TurnBetween(Limb(target.before, bone), Limb(shown.before, bone));
    const LimbTurn now = TurnBetween(Limb(target.now, bone), Limb(shown.now, bone));
    // Beyond half a turn the rotation vector flips its sign between two frames, which would give a wrong velocity.
    const bool flipped = glm::dot(before, now) < 0 && glm::length(now) > 0.5 * kPi;
    limbs_[Index(bone.child)] = measure(flipped ? now : before, now);
  }
}

BodyPose Inertialiser::Apply(const BodyPose& target, double seconds) const {
  BodyPose pose;
  pose[Role::kHipCentre] = target[Role::kHipCentre] + law_(hips_, seconds);
  for (const Bone& bone : AllBones()) {
    const LimbTurn turn = law_(limbs_[Index(bone.child)], seconds);
    pose[bone.child] = pose[bone.parent] + Turned(Limb(target, bone), turn);
  }
  return pose;
}

glm::dvec3 SpringDecay(const Offset& offset, double seconds, const SpringOptions& options) {
  const double y = 2.0 * std::numbers::ln2 / options.half_life_s;
  return std::exp(-y * seconds) * (offset.value + (offset.velocity + y * offset.value) * seconds);
}

Blend InertialiseSpring(const JoinInput& input, const SpringOptions& options) {
  return Inertialise<SpringDecay>(input, options);
}

const SettingTable<QuinticOptions>& QuinticSettings() {
  static const SettingTable<QuinticOptions> kSettings(
      {{"blend_s", &QuinticOptions::blend_s, 0, 5,
        "Blend length: seconds from the transition point until only the new motion is shown."}});
  return kSettings;
}

glm::dvec3 QuinticDecay(const Offset& offset, double seconds, const QuinticOptions& options) {
  const double x0 = glm::length(offset.value);
  if (x0 == 0) return glm::dvec3(0);
  const glm::dvec3 axis = offset.value / x0;
  const double v0 = std::min(glm::dot(offset.velocity, axis), 0.0);
  // A parabola that starts at x0 with slope v0 comes to rest at −2 x0/v0; Bollo allows the quintic 5/2 of that time.
  const double t1 = v0 < 0 ? std::min(options.blend_s, -5 * x0 / v0) : options.blend_s;
  if (seconds >= t1) return glm::dvec3(0);
  const double a0 = std::max(0.0, (-8 * v0 * t1 - 20 * x0) / (t1 * t1));
  // x(s) with s = t/t1 satisfies x(0) = x0, x'(0) = v0, x''(0) = a0, and x, x' and x'' are zero at s = 1.
  const double s = seconds / t1, v = v0 * t1, a = a0 * t1 * t1;
  const double c3 = -0.5 * (3 * a + 12 * v + 20 * x0);
  const double c4 = 0.5 * (3 * a + 16 * v + 30 * x0);
  const double c5 = -0.5 * (a + 6 * v + 12 * x0);
  return axis * (x0 + s * (v + s * (0.5 * a + s * (c3 + s * (c4 + s * c5)))));
}

Blend InertialiseQuintic(const JoinInput& input, const QuinticOptions& options) {
  return Inertialise<QuinticDecay>(input, options);
}

glm::dvec3 DecayingWay(const glm::dvec3& velocity, double seconds, double half_life_s) {
  const double rate = std::numbers::ln2 / half_life_s;
  return velocity * (-std::expm1(-rate * seconds) / rate);
}

const SettingTable<DeadOptions>& DeadSettings() {
  static const SettingTable<DeadOptions> kSettings(
      {{"blend_s", &DeadOptions::blend_s, 0, 5,
        "Blend length: seconds from the transition point until only the new motion is shown."},
       {"half_life_s", &DeadOptions::half_life_s, 0.01, 10,
        "Time in which the velocity of the old motion decays to one half."}});
  return kSettings;
}

Blend DeadBlending(const JoinInput& input, const DeadOptions& options) {
  // Compute the continuation of the old motion by inertialisation. Its target is the last shown frame at rest, so the
  // offset is zero at first, and its velocity is the old motion's velocity.
  const DecayLaw law = [options](const Offset& offset, double seconds) {
    return DecayingWay(offset.velocity, seconds, options.half_life_s);
  };
  const BodyPose last = input.shown.now;
  JoinInput still = input;
  still.target = {last, last};
  return [=, continuation = Inertialiser(still, law), rate_hz = input.rate_hz](const BodyPose& target, int frames) {
    const double seconds = frames / rate_hz;
    if (seconds >= options.blend_s) return target;
    return PoseBetween(continuation.Apply(last, seconds), target, Smoothstep(0, options.blend_s, seconds));
  };
}

}  // namespace etude
