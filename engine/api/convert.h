#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>

#include <utility>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"

namespace etude::engine {

/// Returns what a result holds, or throws its error as BadInput.
template <typename T>
T OrThrow(Result<T> result) {
  if (!result) throw BadInput(ToString(result.error()));
  return *std::move(result);
}

Motion FromBodyMotion(const BodyMotion& motion);
/// Throws BadInput for a rate that is none, or places that are not finite.
BodyMotion ToBodyMotion(const Motion& motion);

etude::Camera ToEngineCamera(const Camera& camera);

}  // namespace etude::engine
