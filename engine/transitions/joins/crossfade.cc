#include "engine/transitions/joins/crossfade.h"

#include <algorithm>

#include "engine/base/smoothstep.h"
#include "engine/transitions/joins/limbs.h"

namespace etude {

LimbTurns TurnsBack(const BodyPose& from, const BodyPose& to) {
  LimbTurns turns{};
  for (const Bone& bone : AllBones()) {
    turns[Index(bone.child)] = TurnBetween(to[bone.child] - to[bone.parent], from[bone.child] - from[bone.parent]);
  }
  return turns;
}

BodyPose PoseBetween(const BodyPose& from, const BodyPose& to, const LimbTurns& back, double share) {
  BodyPose pose;
  pose[Role::kHipCentre] = glm::mix(from[Role::kHipCentre], to[Role::kHipCentre], share);
  for (const Bone& bone : AllBones()) {
    const glm::dvec3 limb = to[bone.child] - to[bone.parent];
    pose[bone.child] = pose[bone.parent] + Turned(limb, (1 - share) * back[Index(bone.child)]);
  }
  return pose;
}

BodyPose PoseBetween(const BodyPose& from, const BodyPose& to, double share) {
  return PoseBetween(from, to, TurnsBack(from, to), share);
}

const SettingTable<CrossfadeOptions>& CrossfadeSettings() {
  static const SettingTable<CrossfadeOptions> kSettings(
      {{"blend_s", &CrossfadeOptions::blend_s, 0, 5,
        "Blend length: seconds from the transition point until only the new motion is shown."}});
  return kSettings;
}

Blend Crossfade(const JoinInput& input, const CrossfadeOptions& options) {
  const double blend_frames = options.blend_s * input.rate_hz;
  std::vector<BodyPose> old = input.continuation(static_cast<std::size_t>(blend_frames) + 1);
  if (old.empty()) old.push_back(input.shown.now);
  return [old = std::move(old), blend_frames](const BodyPose& target, int frames) {
    if (frames >= blend_frames) return target;
    const std::size_t shown = std::min(static_cast<std::size_t>(frames), old.size());
    return PoseBetween(old[shown - 1], target, Smoothstep(0, blend_frames, frames));
  };
}

}  // namespace etude
