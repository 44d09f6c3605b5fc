#pragma once

#include <glm/glm.hpp>

namespace etude {

/// A point Q of a limb L of a tree.
struct TreePoint {
  int joint = 0;       ///< whose limb it is fixed to
  glm::dvec3 p_LQ{0};  ///< metres
};

}  // namespace etude
