#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/motion_faults.h"
#include "engine/motion/support.h"
#include "io/clips/open_clip.h"

namespace etude {

/// The body of a clip, at the position and the rate that the clip's file states.
struct BodyInPlace {
  BodyMotion motion;                    ///< the twenty joints at the file's own rate and heights, metres, Y up
  /// The time of the first frame: above 0 if a leading T-pose, or frames before the body is complete, were left out.
  double begin_s = 0;
  double lost_after_s = 0;              ///< duration of the file's last frames that were left out because joints are
                                        ///< missing, seconds
  double lost_before_s = 0;             ///< duration of the file's first frames that were left out because joints are
                                        ///< missing, seconds
  std::vector<JointSet> unseen = {};    ///< for each frame: joints that the file does not show (FaultOptions::unseen)
  bool is_of_markers = false;           ///< true if the joints were found from markers on the skin
  std::vector<std::string> notes = {};  ///< findings and corrections (BodyConversion::changes)
};

/// Returns the options for finding faults in this body; `floor_m` becomes FaultOptions::floor_m.
FaultOptions FaultOptionsOf(const BodyInPlace& body, std::optional<double> floor_m = {});

/// Finds the body of a clip with UnderstandClip, and moves the body back to the height that it has in the file. Fails
/// if UnderstandClip fails.
Result<BodyInPlace> BodyInPlaceOf(SourceClip clip, const OpenOptions& options);

/// Reads one clip (ReadOneClip) and finds its body.
Result<BodyInPlace> OpenBodyInPlace(const std::string& reference, const OpenOptions& options);

}  // namespace etude
