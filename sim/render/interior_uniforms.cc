#include "sim/render/interior_uniforms.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "sim/render/pixel_geometry.h"

namespace etude {
namespace {

// Numbers of paints, as the shader has them.
constexpr int kFirstPicturePaint = 4, kFirstBoxPaint = 12;
static_assert(kFirstBoxPaint - kFirstPicturePaint == kMostWallPictures);
static_assert(kFirstBoxPaint + kMostFurnitureBoxes <= kMostPaints);

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
  const std::size_t count = std::min(furniture.size(), kMostFurnitureBoxes);
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
  const std::size_t count = std::min(pictures.size(), kMostWallPictures);
  std::vector<glm::vec4> places, frames;
  std::vector<SurfacePaint> paints;
  for (std::size_t i = 0; i < count; ++i) {
    const WallPicture& picture = pictures[i];
    places.emplace_back(glm::vec2(picture.centre), glm::vec2(picture.half_size));
    // Sixteen steps of glow share a number with the wall.
    const int glow = static_cast<int>(std::lround(16 * std::clamp(picture.glow, 0.0, 1.0)));
    frames.emplace_back(ToShares(picture.frame), static_cast<float>(WallNumber(picture.wall) + 8 * glow));
    paints.push_back(picture.paint);
  }
  SetArray(gl, program, "picture_place", places);
  SetArray(gl, program, "picture_frame", frames);
  SetPaints(gl, program, paints, kFirstPicturePaint);
  gl.Uniform1i(gl.GetUniformLocation(program, "pictures"), static_cast<GLint>(count));
}

}  // namespace

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
