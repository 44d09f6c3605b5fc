#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/angles.h"
#include "engine/transitions/joins/limbs.h"
#include "engine/transitions/library/library.h"
#include "sim/random/stream.h"
#include "tests/engine/fuzzy/posed_body.h"

namespace etude {

/// Returns a body that walks along a curve while each limb swings about its own axis. The motion is smooth, and no two
/// clips are alike. At `wildness` 0 the body stands still; at 1 limbs swing by up to 90° to both sides.
inline BodyMotion RandomClip(RandomStream& dice, int frames, double wildness) {
  struct Swing {
    glm::dvec3 axis;
    double radians, hertz, phase;
  };
  std::array<Swing, kRoleCount> swings{};
  for (Swing& swing : swings) {
    swing = {glm::normalize(dice.Normal3() + glm::dvec3(1e-6, 0, 0)), wildness * dice.Uniform(0, 0.5 * kPi),
             dice.Uniform(0.1, 1.5), dice.Uniform(0, 2 * kPi)};
  }
  PosedBody body;
  const BodyPose rest = body.Pose();
  const double turning = wildness * dice.Uniform(-2, 2), walking = wildness * dice.Uniform(-1, 1);
  BodyMotion motion;
  for (int f = 0; f < frames; ++f) {
    const double seconds = f / motion.rate_hz;
    BodyPose pose;
    pose[Role::kHipCentre] = rest[Role::kHipCentre];
    for (const Bone& bone : AllBones()) {
      const Swing& swing = swings[Index(bone.child)];
      const double angle = swing.radians * std::sin(2 * kPi * swing.hertz * seconds + swing.phase);
      pose[bone.child] = pose[bone.parent] + Turned(rest[bone.child] - rest[bone.parent], swing.axis * angle);
    }
    motion.poses.push_back(FloorMove{.yaw = turning * seconds, .x = walking * seconds, .z = 5}.Apply(pose));
  }
  return motion;
}

inline MotionLibrary RandomLibrary(RandomStream& dice, const std::vector<int>& lengths) {
  std::vector<BodyMotion> clips;
  std::vector<std::string> names;
  for (int frames : lengths) {
    clips.push_back(RandomClip(dice, frames, dice.Uniform()));
    names.push_back("clip" + std::to_string(names.size()));
  }
  return MakeLibrary(names, clips, MakeBodyProportions(PosedBody().Pose(), PosedBody::kStandingHipHeight));
}

}  // namespace etude
