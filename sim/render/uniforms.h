#pragma once

#include "engine/cameras/camera.h"
#include "sim/render/gl_context.h"
#include "sim/render/scene.h"

namespace etude {

/// Tells `program` (in use) how this camera's pixels and rays belong together, and where the room's
/// surfaces and its lamp are.
void SetPixelGeometry(const GlFunctions& gl, GLuint program, const Camera& camera, const Room& room);

/// Tells `program` (in use) how the room's lights shine.
void SetLights(const GlFunctions& gl, GLuint program, const Lights& lights);

/// Tells `program` (in use) the paints `first`, `first` + 1, ….
void SetPaints(const GlFunctions& gl, GLuint program, const std::vector<SurfacePaint>& paints, int first = 0);

void SetPoint(const GlFunctions& gl, GLuint program, const char* name, const glm::dvec3& point);
glm::vec3 ToShares(Rgb8 colour);

/// Tells `program` (in use: InteriorFragmentShader) what stands in the room.
void SetInterior(const GlFunctions& gl, GLuint program, const Interior& interior);

}  // namespace etude
