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

/// The body of a clip where its file has it.
struct BodyInPlace {
  BodyMotion motion;                    ///< the twenty joints at the file's own rate and heights, metres, Y up
  double begin_s = 0;        ///< the time of the first frame: a leading T-pose, and frames of a file before its body is
                             ///< whole, are left out
  double lost_after_s = 0;   ///< FaultOptions::lost_after_s
  double lost_before_s = 0;  ///< FaultOptions::lost_before_s
  std::vector<JointSet> unseen = {};    ///< FaultOptions::unseen
  bool is_of_markers = false;           ///< FaultOptions::is_of_markers
  std::vector<std::string> notes = {};  ///< BodyConversion::changes
};

/// How the faults of such a body are sought, on this floor (FaultOptions::floor_m).
FaultOptions FaultOptionsOf(const BodyInPlace& body, std::optional<double> floor_m = {});

/// Finds the body of a clip as UnderstandClip does, and puts it back to the height that the file says. Fails as that
/// function does.
Result<BodyInPlace> BodyInPlaceOf(SourceClip clip, const OpenOptions& options);

/// Reads one clip (ReadOneClip) and finds its body.
Result<BodyInPlace> OpenBodyInPlace(const std::string& reference, const OpenOptions& options);

}  // namespace etude
