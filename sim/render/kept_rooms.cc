#include "sim/render/kept_rooms.h"

#include <glm/gtc/type_ptr.hpp>

#include "sim/render/room_texture.h"

namespace etude {
namespace {

// Two stereo cameras, each plain and smooth: about 5 MB apiece at 640 × 480, 20 MB when smooth.
constexpr std::size_t kMostKept = 4;

bool SameView(const Camera& a, const Camera& b) {
  const Intrinsics &i = a.intrinsics, &j = b.intrinsics;
  return i.width == j.width && i.height == j.height && i.fx == j.fx && i.fy == j.fy && i.cx == j.cx && i.cy == j.cy &&
         i.skew == j.skew && a.R_CW == b.R_CW && a.p_WC == b.p_WC;
}

}  // namespace

KeptRooms::~KeptRooms() {
  for (const Kept& kept : kept_) gl_.DeleteTextures(1, &kept.texture);
}

GLuint KeptRooms::FindOrDraw(std::uint64_t texture_seed, const Camera& camera) {
  for (auto it = kept_.begin(); it != kept_.end(); ++it) {
    if (it->texture_seed != texture_seed || !SameView(it->camera, camera)) continue;
    const Kept found = *it;
    kept_.erase(it);
    kept_.push_front(found);
    return found.texture;
  }
  if (kept_.size() == kMostKept) {
    gl_.DeleteTextures(1, &kept_.back().texture);
    kept_.pop_back();
  }
  kept_.push_front({texture_seed, camera, Draw(texture_seed, camera)});
  return kept_.front().texture;
}

GLuint KeptRooms::Draw(std::uint64_t texture_seed, const Camera& camera) {
  const int width = camera.intrinsics.width, height = camera.intrinsics.height;
  const GLuint texture = MakeUnfilteredTexture(gl_);
  GLuint framebuffer = 0;
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  gl_.GenFramebuffers(1, &framebuffer);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);

  gl_.Viewport(0, 0, width, height);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.UseProgram(room_program_);
  SetPixelGeometry(gl_, room_program_, camera);
  const RoomTexture pattern = MakeRoomTexture(texture_seed);
  const auto set_tiles = [this](const char* name, const TilePattern& tiles) {
    gl_.Uniform4fv(gl_.GetUniformLocation(room_program_, name), static_cast<GLsizei>(tiles.size()),
                   glm::value_ptr(tiles.front()));
  };
  set_tiles("floor_tiles", pattern.floor);
  set_tiles("wall_tiles", pattern.wall);
  gl_.Uniform1f(gl_.GetUniformLocation(room_program_, "pixel_angle"), static_cast<float>(1.0 / camera.intrinsics.fx));
  gl_.BindVertexArray(empty_vertices_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.DeleteFramebuffers(1, &framebuffer);
  return texture;
}

}  // namespace etude
