#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/support.h"
#include "io/clips/open_clip.h"

namespace etude {

/// The body of a clip where its file has it.
struct BodyInPlace {
  BodyMotion motion;                    ///< the twenty joints at the file's own rate and heights, metres, Y up
  double begin_s = 0;                   ///< the time of the first frame: a leading T-pose is left out
  std::vector<JointSet> unseen = {};    ///< FaultOptions::unseen
  std::vector<std::string> notes = {};  ///< BodyConversion::changes
};

/// Finds the body of a clip as UnderstandClip does, and puts it back to the height that the file says. Fails as that
/// function does.
Result<BodyInPlace> BodyInPlaceOf(SourceClip clip, const OpenOptions& options);

/// Reads one clip (ReadOneClip) and finds its body.
Result<BodyInPlace> OpenBodyInPlace(const std::string& reference, const OpenOptions& options);

}  // namespace etude
