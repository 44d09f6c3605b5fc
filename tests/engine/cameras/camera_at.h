#pragma once

#include <cmath>

#include "engine/base/angles.h"
#include "engine/cameras/camera.h"

namespace etude {

/// Returns the position (metres) of a camera that looks at a person who faces +Z. The camera stands `degrees` from
/// the front, towards +X.
inline glm::dvec3 EyeAt(double degrees) {
  const double a = Radians(degrees);
  return {3.8 * std::sin(a), 1.4, 3.8 * std::cos(a)};
}

inline ProjectionMatrix CameraAt(double degrees) { return MatrixOf(LookAt({}, EyeAt(degrees), {0, 0.9, 0})); }

}  // namespace etude
