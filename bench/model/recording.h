#pragma once

#include <string>
#include <string_view>

#include "bench/model/row.h"
#include "engine/base/digest.h"
#include "engine/motion/body.h"
#include "io/files/json.h"

namespace etude {

/// One motion of a recording, and its name ("truth", "solution", …).
struct Track {
  std::string name;  ///< e.g. "truth", "recovered", "coach"
  BodyMotion motion;
};

/// Returns the motion with this name; null if there is none.
const BodyMotion* FindTrack(const Recording& recording, std::string_view name);

/// Encodes a pose for recordings and for messages to outside methods: x, y, z of the twenty joints in the order of
/// AllRoles; sixty numbers, metres, Y up. The numbers are not rounded, so outside methods receive the same values as
/// built-in methods.
Json EncodePose(const BodyPose& pose);

/// Adds the position of every joint to a digest.
void AddTo(Digest& digest, const BodyPose& pose);

}  // namespace etude
