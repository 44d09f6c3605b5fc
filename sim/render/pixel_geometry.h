#pragma once

#include "engine/cameras/camera.h"
#include "sim/render/gl_context.h"

namespace etude {

/// Tells `program` (in use) how this camera's pixels and rays belong together, and where the room's
/// surfaces and its lamp are.
void SetPixelGeometry(const GlFunctions& gl, GLuint program, const Camera& camera);

}  // namespace etude
