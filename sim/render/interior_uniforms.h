#pragma once

#include "sim/render/gl_context.h"
#include "sim/render/interior.h"

namespace etude {

/// Tells `program` (in use: InteriorFragmentShader) what stands in the room.
void SetInterior(const GlFunctions& gl, GLuint program, const Interior& interior);

}  // namespace etude
