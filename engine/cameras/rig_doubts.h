#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/cameras/pose2sim_file.h"

namespace etude {

/// Returns doubts about the cameras of a rig, one sentence each *(ours)*: a principal point that is outside of the
/// picture or would be the middle of a picture of another size, and a camera whose field of view does not overlap with
/// that of any other camera. Such cameras are possible (a picture may be cut out of a larger one), but usually a file
/// was written or read wrongly. A camera without a picture size is not judged.
std::vector<std::string> RigDoubts(std::span<const NamedCamera> cameras);

}  // namespace etude
