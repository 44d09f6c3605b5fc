#pragma once

#include "engine/cameras/camera.h"
#include "sim/render/gl_context.h"
#include "sim/render/scene.h"

namespace etude {

/// Sets the camera's pixel geometry, the position of the studio's wall, and the room's lamp in `program`, which must be
/// in use.
void SetPixelGeometry(const GlFunctions& gl, GLuint program, const Camera& camera, const Room& room);

/// Sets the room's lights in `program`, which must be in use.
void SetLights(const GlFunctions& gl, GLuint program, const Lights& lights);

/// Sets the paints `first`, `first` + 1, … in `program`, which must be in use.
void SetPaints(const GlFunctions& gl, GLuint program, const std::vector<SurfacePaint>& paints, int first = 0);

/// Sets the vec3 uniform `name` in `program`, which must be in use.
void SetPoint(const GlFunctions& gl, GLuint program, const char* name, const glm::dvec3& point);
/// Returns the colour's channels as shares, 0…1.
glm::vec3 ToShares(Rgb8 colour);

/// Sets the walls, the furniture and the pictures of an interior in `program` (InteriorFragmentShader), which must be
/// in use.
void SetInterior(const GlFunctions& gl, GLuint program, const Interior& interior);

}  // namespace etude
