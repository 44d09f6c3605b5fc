#pragma once

#include <vector>

#include "engine/base/image.h"
#include "sim/render/gl_context.h"

namespace etude {

/// The textures that GL has been given: a figure's stay from picture to picture. Lives as long as its context.
class TextureStore {
 public:
  /// Where shaders find the bound texture; unit 0 is the room's.
  static constexpr GLint kUnit = 1;

  explicit TextureStore(const GlFunctions& gl) : gl_(gl) {}

  /// Binds it to the unit, handed to GL first if need be, with ever smaller copies for what is far away.
  void Bind(const SharedTexture& texture);

 private:
  // Holding on to what was given keeps another texture from taking its address.
  struct Given {
    SharedTexture texture;
    GLuint name = 0;
  };

  GLuint Give(const Texture& texture) const;

  const GlFunctions& gl_;
  std::vector<Given> given_;
};

}  // namespace etude
