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

/// Returns the motion of that name, or null.
const BodyMotion* FindTrack(const Recording& recording, std::string_view name);

/// Encodes a pose for recordings and for the exchange with outside methods: x, y, z of the twenty joints in the order
/// of AllRoles, sixty numbers, metres, Y up. Every digit is kept, so outside methods see the same values as built-in
/// ones.
Json EncodePose(const BodyPose& pose);

/// Adds the position of every joint to a digest.
void AddTo(Digest& digest, const BodyPose& pose);

}  // namespace etude
