#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A named motion of a recording.
struct Track {
  std::string name;  ///< "truth", "recovered", "coach", …
  BodyMotion motion;
};

/// Everything needed to show a cell again without rerunning it: what a video draws.
struct Recording {
  std::vector<Track> tracks;
  /// Free-form facts for the viewer, as JSON text written by the task (cameras, masks, captions).
  std::string extras_json;
};

/// The motion of that name, or null.
const BodyMotion* FindTrack(const Recording& recording, std::string_view name);

}  // namespace etude
