#pragma once

#include <glm/glm.hpp>

#include "engine/base/image.h"
#include "engine/motion/body.h"
#include "io/files/json.h"

namespace etude {

/// These functions read the input of a metric's test vector (docs/reference/metrics.md, "The vectors' inputs"). They
/// throw Json::exception if the input does not fit; `EvaluateMetric` turns the exception into an Error.

/// Reads [x, y, z].
glm::dvec3 ReadPoint(const Json& json);
/// Reads [x, y, z]; null gives nothing.
std::optional<glm::dvec3> ReadOptionalPoint(const Json& json);
/// Reads three axes, each [x, y, z]: the columns of the matrix.
glm::dmat3 ReadAxes(const Json& json);
/// Reads {"left_hand": [x, y, z], …}; a joint that is not named is at the origin.
BodyPose ReadPose(const Json& json);
/// Reads {"rate_hz": 30, "frames": 3, "joints_m": {"left_hand": [[x, y, z], …], …}}: one position per frame, or one for
/// all frames. A joint that is not named stays at the origin. rate_hz is 30 by default.
BodyMotion ReadMotion(const Json& json);
/// Reads rows from the top, each a list of 0 and 1.
Mask ReadMask(const Json& json);

}  // namespace etude
