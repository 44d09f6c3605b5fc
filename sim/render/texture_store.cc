#include "sim/render/texture_store.h"

#include <algorithm>
#include <cassert>

namespace etude {
namespace {

GLint WrapOf(Texture::Beyond beyond) {
  switch (beyond) {
    case Texture::Beyond::kRepeats:
      return GL_REPEAT;
    case Texture::Beyond::kMirrors:
      return GL_MIRRORED_REPEAT;
    case Texture::Beyond::kStays:
      return GL_CLAMP_TO_EDGE;
  }
  return GL_REPEAT;
}

}  // namespace

void TextureStore::Bind(const SharedTexture& texture) {
  gl_.ActiveTexture(GL_TEXTURE0 + kUnit);
  auto found = std::ranges::find(given_, texture, &Given::texture);
  if (found != given_.end()) {
    gl_.BindTexture(GL_TEXTURE_2D, found->name);
  } else {
    constexpr std::size_t kMostKept = 64;
    if (given_.size() == kMostKept) {
      for (const Given& old : given_) gl_.DeleteTextures(1, &old.name);
      given_.clear();
    }
    given_.push_back({texture, Give(*texture)});
  }
  gl_.ActiveTexture(GL_TEXTURE0);
}

GLuint TextureStore::Give(const Texture& texture) const {
  const ColourImage& picture = texture.picture;
  assert(picture.width > 0 && picture.height > 0);
  GLuint name = 0;
  gl_.GenTextures(1, &name);
  gl_.BindTexture(GL_TEXTURE_2D, name);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, picture.width, picture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 picture.pixels.data());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_.GenerateMipmap(GL_TEXTURE_2D);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, WrapOf(texture.beyond_u));
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, WrapOf(texture.beyond_v));
  return name;
}

}  // namespace etude
