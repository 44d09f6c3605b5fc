#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "sim/render/renderer.h"

namespace etude {

/// One capsule as the vertex shader's box reads it (shaders.cc); frame E has the world's axes and the
/// origin at the camera's centre.
struct CapsuleInstance {
  glm::vec4 start_and_radius;  ///< in E; of a face, the chin's end
  glm::vec4 end_and_label;     ///< in E
  glm::vec4 paint;             ///< RGB 0…1; A = 1 for a head that gets a face
  glm::vec3 front;             ///< unit; where the face looks
};

/// All capsules of all figures. Capsules that are not finite, or not thicker than nothing, are left out.
std::vector<CapsuleInstance> MakeInstances(const std::vector<Figure>& figures, const glm::dvec3& eye);

}  // namespace etude
