#pragma once

#include <span>
#include <string>

#include "bench/model/recording.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "io/files/json.h"

namespace etude {

/// Encodes a list of poses (EncodePose), one per frame.
Json EncodePoses(std::span<const BodyPose> poses);

/// Describes the order of the sixty numbers: {"joints": [twenty names], "parents": [null, "hip_centre", …]}.
Json DescribeBody();

/// Reads a pose. Another count than sixty, and coordinates that are not finite or exceed a kilometre, are errors that
/// name `path` ("between[3]").
Result<BodyPose> ReadPose(const Json& json, const std::string& path);

}  // namespace etude
