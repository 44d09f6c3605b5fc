#pragma once

#include <span>
#include <string>

#include "bench/model/recording.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "io/files/json.h"

namespace etude {

/// Writes a list of poses (EncodePose), one per frame.
Json EncodePoses(std::span<const BodyPose> poses);

/// Names the joints of the sixty numbers, and their parents: {"joints": [twenty names], "parents": [null, "hip_centre",
/// …]}.
Json DescribeBody();

/// Reads a pose. Refuses, naming `path` ("between[3]"), another count than sixty, and coordinates that are no finite
/// numbers or farther than a kilometre away.
Result<BodyPose> ReadPose(const Json& json, const std::string& path);

}  // namespace etude
