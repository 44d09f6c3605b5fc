#include "sim/render/pixel_geometry.h"

#include <glm/gtc/type_ptr.hpp>

#include "sim/render/renderer.h"

namespace etude {
namespace {

void SetMatrix(const GlFunctions& gl, GLuint program, const char* name, const glm::dmat3& matrix) {
  const glm::mat3 narrow(matrix);
  gl.UniformMatrix3fv(gl.GetUniformLocation(program, name), 1, GL_FALSE, glm::value_ptr(narrow));
}

}  // namespace

void SetPoint(const GlFunctions& gl, GLuint program, const char* name, const glm::dvec3& point) {
  gl.Uniform3f(gl.GetUniformLocation(program, name), static_cast<float>(point.x), static_cast<float>(point.y),
               static_cast<float>(point.z));
}

void SetPixelGeometry(const GlFunctions& gl, GLuint program, const Camera& camera, const Room& room) {
  const Intrinsics& in = camera.intrinsics;
  // Columns, as GLM has it: image (u w, v w, w) = K · direction in C.
  const glm::dmat3 K(in.fx, 0, 0, in.skew, in.fy, 0, in.cx, in.cy, 1);
  SetMatrix(gl, program, "ray_of_pixel", glm::transpose(camera.R_CW) * glm::inverse(K));
  SetMatrix(gl, program, "image_of_direction", K * camera.R_CW);
  gl.Uniform2f(gl.GetUniformLocation(program, "image_size"), static_cast<float>(in.width),
               static_cast<float>(in.height));
  SetPoint(gl, program, "eye", camera.p_WC);
  SetPoint(gl, program, "lamp", LightsOf(room).key);
  gl.Uniform1f(gl.GetUniformLocation(program, "wall_z"), static_cast<float>(kWallZ));
}

Lights LightsOf(const Room& room) { return room.interior != nullptr ? room.interior->lights : Lights{.key = kLamp}; }

void SetLights(const GlFunctions& gl, GLuint program, const Lights& lights) {
  SetPoint(gl, program, "key_colour", lights.key_colour);
  SetPoint(gl, program, "ambient_colour", lights.ambient_colour);
  SetPoint(gl, program, "fill_direction", lights.fill);
  SetPoint(gl, program, "fill_colour", lights.fill_colour);
  SetPoint(gl, program, "window", lights.window);
  SetPoint(gl, program, "window_colour", lights.window_colour);
}

glm::vec3 ToShares(Rgb8 colour) { return glm::vec3(colour.r, colour.g, colour.b) / 255.0f; }

void SetPaints(const GlFunctions& gl, GLuint program, const std::vector<SurfacePaint>& paints, int first) {
  std::vector<glm::vec4> firsts, seconds, patches;
  for (const SurfacePaint& paint : paints) {
    firsts.emplace_back(ToShares(paint.first), static_cast<float>(paint.pattern));
    seconds.emplace_back(ToShares(paint.second), static_cast<float>(paint.size));
    const bool has_patch = paint.patch_half.x > 0 && paint.patch_half.y > 0;
    // Cloth is told by a negative width, a patch by a height.
    const double width = has_patch ? paint.patch_half.x : 1;
    patches.emplace_back(glm::vec2(paint.patch), paint.is_cloth ? -width : width, has_patch ? paint.patch_half.y : 0);
  }
  const auto set = [&](const char* name, const std::vector<glm::vec4>& values) {
    const GLint at = gl.GetUniformLocation(program, (std::string(name) + "[" + std::to_string(first) + "]").c_str());
    gl.Uniform4fv(at, static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
  };
  if (paints.empty()) return;
  set("paint_first", firsts);
  set("paint_second", seconds);
  set("paint_patch", patches);
}

}  // namespace etude
