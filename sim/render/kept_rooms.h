#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "sim/render/gl_context.h"
#include "sim/render/lamp_view.h"
#include "sim/render/renderer.h"

namespace etude {

/// The empty room as one camera sees it at brightness 1, as textures for shaders and as numbers for what needs none.
struct KeptRoom {
  std::uint64_t serial = 0;          ///< 1 for the first that was drawn, and so on
  GLuint room = 0;                   ///< RGB colour, A depth
  GLuint extra = 0;                  ///< RGB the lamp's share of the light, A label
  std::vector<float> colours;        ///< RGB, three per pixel
  std::vector<float> lamp_shares;    ///< likewise: of the light, how much is the lamp's
  std::vector<float> depths;         ///< metres
  std::vector<std::uint8_t> labels;  ///< one per pixel
  LampView lamp;
};

/// Pictures of the empty room, one per camera, because cameras stand still while people move. The few last used are
/// kept.
class KeptRooms {
 public:
  /// The programs draw the studio and interiors (shaders.h) and outlive this; so does `empty_vertices`, a
  /// vertex array without attributes.
  KeptRooms(const GlFunctions& gl, GLuint studio_program, GLuint interior_program, GLuint empty_vertices)
      : gl_(gl),
        studio_program_(studio_program),
        interior_program_(interior_program),
        empty_vertices_(empty_vertices) {}
  ~KeptRooms();
  KeptRooms(const KeptRooms&) = delete;
  KeptRooms& operator=(const KeptRooms&) = delete;

  /// The room seen by `camera`. Changes GL's framebuffer, viewport and program when it has to draw.
  const KeptRoom& FindOrDraw(const Room& room, const Camera& camera);

 private:
  struct Kept {
    std::uint64_t texture_seed;
    std::optional<Interior> interior;
    Camera camera;
    KeptRoom picture;
  };
  KeptRoom Draw(const Room& room, const Camera& camera);
  void Drop(const Kept& kept);

  const GlFunctions& gl_;
  GLuint studio_program_, interior_program_;
  GLuint empty_vertices_;
  std::uint64_t drawn_ = 0;
  std::deque<Kept> kept_;  // the last used first
};

}  // namespace etude
