#pragma once

#include <cmath>

#include "engine/base/angles.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude::testing {

/// Returns a standing person with straight arms, raised sideways by `left` and `right` degrees from hanging.
inline BodyPose ArmsAt(double left, double right) {
  using enum Role;
  BodyPose pose;
  const auto put = [&](Role role, double x, double y) { pose[role] = glm::dvec3(x, y, 0); };
  put(kHipCentre, 0, 0.95), put(kSpine, 0, 1.15), put(kShoulderCentre, 0, 1.42), put(kHead, 0, 1.65);
  for (const auto& [shoulder, hip, side, angle] :
       {std::tuple{kLeftShoulder, kLeftHip, 1.0, left}, std::tuple{kRightShoulder, kRightHip, -1.0, right}}) {
    const auto at = [](Role role, int i) { return static_cast<Role>(Index(role) + static_cast<std::size_t>(i)); };
    const double s = side * std::sin(Radians(angle)), c = -std::cos(Radians(angle));
    const double lengths[] = {0, 0.28, 0.52, 0.62};
    for (int i = 0; i < 4; ++i) put(at(shoulder, i), side * 0.18 + lengths[i] * s, 1.4 + lengths[i] * c);
    put(hip, side * 0.09, 0.92), put(at(hip, 1), side * 0.1, 0.5), put(at(hip, 2), side * 0.1, 0.08);
    put(at(hip, 3), side * 0.1, 0);
    pose[at(hip, 3)].z = 0.15;
  }
  return pose;
}

/// Returns a recording in which both arms go from `low` to `high` degrees and back in `seconds`, with half a second of
/// rest before and after.
inline SkeletonStream Raise(double low, double high, double seconds = 2) {
  BodyMotion motion;
  const int move = static_cast<int>(30 * seconds), rest = 15;
  for (int t = -rest; t < move + rest; ++t) {
    const double part = t < 0 || t >= move ? 0 : 0.5 - 0.5 * std::cos(2 * kPi * t / move);
    motion.poses.push_back(ArmsAt(low + (high - low) * part, low + (high - low) * part));
  }
  return StreamOf(motion);
}

}  // namespace etude::testing
