#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/base/image.h"
#include "engine/motion/body.h"
#include "io/files/json.h"

namespace etude {

/// The pieces that the inputs of test vectors are made of (docs/reference/metrics.md, "The vectors' inputs"). All throw
/// Json::exception for what does not fit; `EvaluateMetric` turns that into an Error.

/// [x, y, z].
glm::dvec3 ReadPoint(const Json& json);
/// Like ReadPoint; null is nothing.
std::optional<glm::dvec3> ReadOptionalPoint(const Json& json);
/// Three axes, each [x, y, z]: the columns of the matrix.
glm::dmat3 ReadAxes(const Json& json);
/// {"left_hand": [x, y, z], …}; a joint that is not named is at the origin.
BodyPose ReadPose(const Json& json);
/// {"rate_hz": 30, "frames": 3, "joints_m": {"left_hand": [[x, y, z], …], …}}: one position per frame, or one for all;
/// a joint that is not named stays at the origin; rate_hz is 30 when it is not said.
BodyMotion ReadMotion(const Json& json);
/// Rows from the top, each a list of 0 and 1.
Mask ReadMask(const Json& json);

}  // namespace etude
