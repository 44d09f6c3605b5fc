#pragma once

#include <string>
#include <string_view>

#include "bench/model/row.h"
#include "engine/base/digest.h"
#include "engine/motion/body.h"
#include "io/files/json.h"

namespace etude {

/// A named motion of a recording.
struct Track {
  std::string name;  ///< "truth", "recovered", "coach", …
  BodyMotion motion;
};

/// The motion of that name, or null.
const BodyMotion* FindTrack(const Recording& recording, std::string_view name);

/// Writes a pose as recordings hold it, and as it is told to and by methods outside the program: x, y, z of the twenty
/// joints in the order of AllRoles, sixty numbers, metres, Y up. Every digit is kept, so methods outside see what
/// built-in ones see.
Json EncodePose(const BodyPose& pose);

/// Adds every joint's place to a digest.
void AddTo(Digest& digest, const BodyPose& pose);

}  // namespace etude
