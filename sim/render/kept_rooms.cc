#include "sim/render/kept_rooms.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "sim/render/interior_uniforms.h"
#include "sim/render/pixel_geometry.h"
#include "sim/render/room_texture.h"

namespace etude {
namespace {

// The largest rig: about 25 MB apiece at 640 × 480, 100 MB when smooth.
constexpr std::size_t kMostKept = 8;

bool SameView(const Camera& a, const Camera& b) {
  const Intrinsics &i = a.intrinsics, &j = b.intrinsics;
  return i.width == j.width && i.height == j.height && i.fx == j.fx && i.fy == j.fy && i.cx == j.cx && i.cy == j.cy &&
         i.skew == j.skew && a.R_CW == b.R_CW && a.p_WC == b.p_WC;
}

bool SameInterior(const std::optional<Interior>& kept, const Interior* wanted) {
  return wanted == nullptr ? !kept : kept && *kept == *wanted;
}

void SetTiles(const GlFunctions& gl, GLuint program, std::uint64_t seed) {
  const RoomTexture pattern = MakeRoomTexture(seed);
  const auto set = [&](const char* name, const TilePattern& tiles) {
    gl.Uniform4fv(gl.GetUniformLocation(program, name), static_cast<GLsizei>(tiles.size()),
                  glm::value_ptr(tiles.front()));
  };
  set("floor_tiles", pattern.floor);
  set("wall_tiles", pattern.wall);
}

}  // namespace

KeptRooms::~KeptRooms() {
  for (const Kept& kept : kept_) Drop(kept);
}

void KeptRooms::Drop(const Kept& kept) {
  gl_.DeleteTextures(1, &kept.picture.room);
  gl_.DeleteTextures(1, &kept.picture.extra);
}

const KeptRoom& KeptRooms::FindOrDraw(const Room& room, const Camera& camera) {
  const auto found = std::ranges::find_if(kept_, [&](const Kept& kept) {
    return kept.texture_seed == room.texture_seed && SameView(kept.camera, camera) &&
           SameInterior(kept.interior, room.interior);
  });
  if (found != kept_.end()) {
    std::rotate(kept_.begin(), found, found + 1);
    return kept_.front().picture;
  }
  if (kept_.size() == kMostKept) {
    Drop(kept_.back());
    kept_.pop_back();
  }
  const auto interior = room.interior != nullptr ? std::optional(*room.interior) : std::nullopt;
  kept_.push_front({room.texture_seed, interior, camera, Draw(room, camera)});
  return kept_.front().picture;
}

KeptRoom KeptRooms::Draw(const Room& room, const Camera& camera) {
  const int width = camera.intrinsics.width, height = camera.intrinsics.height;
  KeptRoom kept;
  kept.serial = ++drawn_;
  GLuint framebuffer = 0;
  gl_.GenFramebuffers(1, &framebuffer);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  for (int i = 0; i < 2; ++i) {
    GLuint& texture = i == 0 ? kept.room : kept.extra;
    texture = MakeUnfilteredTexture(gl_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, texture, 0);
  }
  gl_.DrawBuffers(2, attachments);
  for (GLuint i = 0; i < 2; ++i)
    gl_.ColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);  // the last picture's are still on

  gl_.Viewport(0, 0, width, height);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_SCISSOR_TEST);
  const GLuint program = room.interior != nullptr ? interior_program_ : studio_program_;
  gl_.UseProgram(program);
  SetPixelGeometry(gl_, program, camera, room);
  SetTiles(gl_, program, room.texture_seed);
  gl_.Uniform1f(gl_.GetUniformLocation(program, "pixel_angle"), static_cast<float>(1.0 / camera.intrinsics.fx));
  if (room.interior != nullptr) SetInterior(gl_, program, *room.interior);
  gl_.BindVertexArray(empty_vertices_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);

  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  std::vector<float> four(4 * pixels);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, four.data());
  kept.colours.resize(3 * pixels);
  kept.depths.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::copy_n(&four[4 * i], 3, &kept.colours[3 * i]);
    kept.depths[i] = four[4 * i + 3];
  }
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, four.data());
  kept.lamp_shares.resize(3 * pixels);
  kept.labels.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::copy_n(&four[4 * i], 3, &kept.lamp_shares[3 * i]);
    kept.labels[i] = static_cast<std::uint8_t>(four[4 * i + 3]);
  }
  gl_.DeleteFramebuffers(1, &framebuffer);
  kept.lamp = SeeFromLamp(kept.depths, camera, LightsOf(room).key);
  return kept;
}

}  // namespace etude
