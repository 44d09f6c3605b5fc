#include "sim/render/pixel_geometry.h"

#include <glm/gtc/type_ptr.hpp>

#include "sim/render/renderer.h"

namespace etude {
namespace {

void SetMatrix(const GlFunctions& gl, GLuint program, const char* name, const glm::dmat3& matrix) {
  const glm::mat3 narrow(matrix);
  gl.UniformMatrix3fv(gl.GetUniformLocation(program, name), 1, GL_FALSE, glm::value_ptr(narrow));
}

void SetPoint(const GlFunctions& gl, GLuint program, const char* name, const glm::dvec3& point) {
  gl.Uniform3f(gl.GetUniformLocation(program, name), static_cast<float>(point.x), static_cast<float>(point.y),
               static_cast<float>(point.z));
}

}  // namespace

void SetPixelGeometry(const GlFunctions& gl, GLuint program, const Camera& camera) {
  const Intrinsics& in = camera.intrinsics;
  // Columns, as GLM has it: image (u w, v w, w) = K · direction in C.
  const glm::dmat3 K(in.fx, 0, 0, in.skew, in.fy, 0, in.cx, in.cy, 1);
  SetMatrix(gl, program, "ray_of_pixel", glm::transpose(camera.R_CW) * glm::inverse(K));
  SetMatrix(gl, program, "image_of_direction", K * camera.R_CW);
  gl.Uniform2f(gl.GetUniformLocation(program, "image_size"), static_cast<float>(in.width),
               static_cast<float>(in.height));
  SetPoint(gl, program, "eye", camera.p_WC);
  SetPoint(gl, program, "lamp", kLamp);
  gl.Uniform1f(gl.GetUniformLocation(program, "wall_z"), static_cast<float>(kWallZ));
}

}  // namespace etude
