#include "sim/render/uniforms.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "sim/render/scene.h"

namespace etude {
namespace {

void SetMatrix(const GlFunctions& gl, GLuint program, const char* name, const glm::dmat3& matrix) {
  const glm::mat3 narrow(matrix);
  gl.UniformMatrix3fv(gl.GetUniformLocation(program, name), 1, GL_FALSE, glm::value_ptr(narrow));
}

// The indices of the first picture and of the first box among the shader's paints.
constexpr int kFirstPicturePaint = 4, kFirstBoxPaint = 12;
static_assert(kFirstBoxPaint - kFirstPicturePaint == kMaxWallPictures);
static_assert(kFirstBoxPaint + kMaxFurnitureBoxes <= kMaxPaints);

int WallNumber(WallPicture::Wall wall) {
  switch (wall) {
    case WallPicture::Wall::kBack:
      return 2;
    case WallPicture::Wall::kLeft:
      return 4;
    case WallPicture::Wall::kRight:
      return 5;
  }
  return 2;
}

void SetArray(const GlFunctions& gl, GLuint program, const char* name, const std::vector<glm::vec4>& values) {
  if (values.empty()) return;
  gl.Uniform4fv(gl.GetUniformLocation(program, name), static_cast<GLsizei>(values.size()),
                glm::value_ptr(values.front()));
}

void SetNumber(const GlFunctions& gl, GLuint program, const char* name, double value) {
  gl.Uniform1f(gl.GetUniformLocation(program, name), static_cast<float>(value));
}

void SetFurniture(const GlFunctions& gl, GLuint program, const std::vector<FurnitureBox>& furniture) {
  const std::size_t count = std::min(furniture.size(), kMaxFurnitureBoxes);
  std::vector<glm::vec4> centres, halves;
  std::vector<SurfacePaint> paints;
  for (std::size_t i = 0; i < count; ++i) {
    const FurnitureBox& box = furniture[i];
    centres.emplace_back(glm::vec3(box.centre), static_cast<float>(std::sin(box.heading)));
    halves.emplace_back(glm::vec3(box.half_size), static_cast<float>(std::cos(box.heading)));
    paints.push_back(box.paint);
  }
  SetArray(gl, program, "box_centre", centres);
  SetArray(gl, program, "box_half", halves);
  SetPaints(gl, program, paints, kFirstBoxPaint);
  gl.Uniform1i(gl.GetUniformLocation(program, "boxes"), static_cast<GLint>(count));
}

void SetPictures(const GlFunctions& gl, GLuint program, const std::vector<WallPicture>& pictures) {
  const std::size_t count = std::min(pictures.size(), kMaxWallPictures);
  std::vector<glm::vec4> positions, frames;
  std::vector<SurfacePaint> paints;
  for (std::size_t i = 0; i < count; ++i) {
    const WallPicture& picture = pictures[i];
    positions.emplace_back(glm::vec2(picture.centre), glm::vec2(picture.half_size));
    // Pack the wall and the glow (in sixteen steps) into one number.
    const int glow = static_cast<int>(std::lround(16 * std::clamp(picture.glow, 0.0, 1.0)));
    frames.emplace_back(ToShares(picture.frame), static_cast<float>(WallNumber(picture.wall) + 8 * glow));
    paints.push_back(picture.paint);
  }
  SetArray(gl, program, "picture_place", positions);
  SetArray(gl, program, "picture_frame", frames);
  SetPaints(gl, program, paints, kFirstPicturePaint);
  gl.Uniform1i(gl.GetUniformLocation(program, "pictures"), static_cast<GLint>(count));
}

}  // namespace

void SetPoint(const GlFunctions& gl, GLuint program, const char* name, const glm::dvec3& point) {
  gl.Uniform3f(gl.GetUniformLocation(program, name), static_cast<float>(point.x), static_cast<float>(point.y),
               static_cast<float>(point.z));
}

void SetPixelGeometry(const GlFunctions& gl, GLuint program, const Camera& camera, const Room& room) {
  const Intrinsics& in = camera.intrinsics;
  // GLM's constructor takes columns. K maps a direction in C to the picture in homogeneous coordinates: (u w, v w, w) =
  // K · direction.
  const glm::dmat3 K(in.fx, 0, 0, in.skew, in.fy, 0, in.cx, in.cy, 1);
  SetMatrix(gl, program, "ray_of_pixel", glm::transpose(camera.R_CW) * glm::inverse(K));
  SetMatrix(gl, program, "image_of_direction", K * camera.R_CW);
  gl.Uniform2f(gl.GetUniformLocation(program, "image_size"), static_cast<float>(in.width),
               static_cast<float>(in.height));
  SetPoint(gl, program, "eye", camera.p_WC);
  SetPoint(gl, program, "lamp", LightsOf(room).key);
  gl.Uniform1f(gl.GetUniformLocation(program, "wall_z"), static_cast<float>(kWallZ));
}

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
    // A negative width marks cloth, and a positive height marks a patch.
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

void SetInterior(const GlFunctions& gl, GLuint program, const Interior& interior) {
  SetPoint(gl, program, "room_low", interior.low);
  SetPoint(gl, program, "room_high", interior.high);
  SetPaints(gl, program, {interior.floor, interior.wall, interior.ceiling, interior.rug_paint});
  SetPoint(gl, program, "skirting", glm::dvec3(ToShares(interior.skirting)));
  SetNumber(gl, program, "studio", interior.studio);
  SetArray(gl, program, "rug", {glm::vec4(interior.rug)});
  SetLights(gl, program, interior.lights);
  SetFurniture(gl, program, interior.furniture);
  SetPictures(gl, program, interior.pictures);
}

}  // namespace etude
