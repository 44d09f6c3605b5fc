#pragma once

#include <deque>

#include "sim/render/gl_context.h"
#include "sim/render/pixel_geometry.h"

namespace etude {

/// Pictures of the empty room at brightness 1, one per camera, because cameras stand still while people
/// move. The few last used are kept.
class KeptRooms {
 public:
  /// `room_program` draws an empty room (shaders.h) and outlives this; so does `empty_vertices`, a
  /// vertex array without attributes.
  KeptRooms(const GlFunctions& gl, GLuint room_program, GLuint empty_vertices)
      : gl_(gl), room_program_(room_program), empty_vertices_(empty_vertices) {}
  ~KeptRooms();
  KeptRooms(const KeptRooms&) = delete;
  KeptRooms& operator=(const KeptRooms&) = delete;

  /// The texture that holds the room seen by `camera`: RGB colour, A depth. Changes GL's framebuffer,
  /// viewport and program when it has to draw.
  GLuint FindOrDraw(std::uint64_t texture_seed, const Camera& camera);

 private:
  struct Kept {
    std::uint64_t texture_seed;
    Camera camera;
    GLuint texture;
  };
  GLuint Draw(std::uint64_t texture_seed, const Camera& camera);

  const GlFunctions& gl_;
  GLuint room_program_;
  GLuint empty_vertices_;
  std::deque<Kept> kept_;  // the last used first
};

}  // namespace etude
