#pragma once

#include <string>
#include <string_view>

#include "bench/model/row.h"
#include "engine/base/digest.h"
#include "engine/motion/body.h"

namespace etude {

/// A named motion of a recording.
struct Track {
  std::string name;  ///< "truth", "recovered", "coach", …
  BodyMotion motion;
};

/// The motion of that name, or null.
const BodyMotion* FindTrack(const Recording& recording, std::string_view name);

/// Adds every joint's place to a digest.
void AddTo(Digest& digest, const BodyPose& pose);

}  // namespace etude
