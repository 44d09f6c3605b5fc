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

/// Describes the order of the sixty numbers of a pose: {"joints": [twenty names], "parents": [null, "hip_centre", …]}.
Json DescribeBody();

/// Reads a pose. Fails if there are not sixty numbers, or if a coordinate is not finite or exceeds a kilometre. The
/// error names `path` ("between[3]").
Result<BodyPose> ReadPose(const Json& json, const std::string& path);

}  // namespace etude
