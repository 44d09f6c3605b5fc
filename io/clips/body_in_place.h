#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/motion_faults.h"
#include "engine/motion/support.h"
#include "io/clips/open_clip.h"

namespace etude {

/// A shorter stretch of a body's frames, which a gap of over a second separates from the others.
struct OtherStretch {
  double begin_s = 0;  ///< time of the first frame by the clock of BodyInPlace::begin_s
  BodyMotion motion;
  std::vector<JointSet> unseen = {};  ///< as BodyInPlace::unseen
};

/// The body of a clip, at the position and the rate that the clip's file states. If joints are missing for over a
/// second, the motion is the longest stretch without such a gap.
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
  std::vector<std::string> doubts = {};  ///< the entries of `notes` that state what looks wrong in the file
  bool is_floor_known = true;           ///< MarkerBody::is_floor_known
  std::vector<OtherStretch> others = {};  ///< the other stretches, in order of time; empty: see OpenBodyInPlace
};

/// Finds the body of a clip with UnderstandClip, and moves the body back to the height that it has in the file. Fails
/// if UnderstandClip fails.
Result<BodyInPlace> BodyInPlaceOf(SourceClip clip, const OpenOptions& options);

/// The faults of all stretches of a body.
struct FaultsInPlace {
  MotionFaults found;
  std::size_t frames = 0;  ///< number of judged frames
  double judged_s = 0;     ///< duration of the judged stretches
  double file_s = 0;       ///< duration of the file, with the frames that lack needed joints
  /// The times that are not judged, because joints are missing or a stretch has fewer than kMinFramesForFaults frames.
  std::vector<std::pair<double, double>> not_judged_s = {};
};

/// Finds the faults of each stretch; the longest one determines the floor. Each gap between two stretches is a fault of
/// its own. `floor_m` has the meaning of FaultOptions::floor_m.
FaultsInPlace FindFaultsInPlace(const BodyInPlace& body, std::optional<double> floor_m = {});

/// Reads one clip (ReadOneClip) and finds its body, with all its stretches.
Result<BodyInPlace> OpenBodyInPlace(const std::string& reference, const OpenOptions& options);

}  // namespace etude
