#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "engine/base/image.h"
#include "sim/render/gl_context.h"
#include "sim/render/scene.h"

namespace etude {

/// The vertex data of one draw call, sent anew for every picture: corners of triangles, or instances of one triangle
/// strip whose corners the shader makes up. Lives as long as its context.
class VertexStream {
 public:
  /// An input of the shader: `size` floats, `offset` bytes into an element. The first has location 0, and so on.
  struct Attribute {
    int size;
    std::size_t offset;
  };
  /// Makes the vertex array. `strip_length` is the number of corners of the strip that each element stands for; 0 when
  /// elements are corners.
  VertexStream(const GlFunctions& gl, std::size_t element_bytes, GLsizei strip_length,
               std::initializer_list<Attribute> attributes);

  template <typename Element>
  void Upload(const std::vector<Element>& elements) {
    Upload(elements.data(), elements.size(), sizeof(Element));
  }
  /// Uploads corners: those of triangles are the ones that `indices` name.
  template <typename Element>
  void Upload(const std::vector<Element>& elements, const std::vector<std::uint32_t>& indices) {
    Upload(elements.data(), elements.size(), sizeof(Element));
    Index(indices);
  }
  bool IsEmpty() const { return count_ == 0; }
  void Draw() const;
  /// Draws only `count` indices from `first` on; for streams of corners.
  void DrawSome(std::size_t first, std::size_t count) const;

 private:
  void Upload(const void* data, std::size_t count, std::size_t element_bytes);
  void Index(const std::vector<std::uint32_t>& indices);

  const GlFunctions& gl_;
  GLsizei strip_length_;
  GLsizei count_ = 0;  ///< of instances, or of indices
  GLuint vertices_ = 0;
  GLuint buffer_ = 0, indices_ = 0;
};

/// The textures that GL has been given: a figure's stay from picture to picture. Lives as long as its context.
class TextureStore {
 public:
  /// The texture unit where shaders find the bound texture; unit 0 is the room's.
  static constexpr GLint kUnit = 1;

  explicit TextureStore(const GlFunctions& gl) : gl_(gl) {}

  /// Binds a texture to the unit; a texture that is new is handed to GL first, with mipmaps.
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

/// The framebuffer that pictures are drawn into: colour, labels, linear depth, and a depth buffer for
/// hidden surfaces. It grows to the largest picture asked for; smaller ones use its corner. Only what is drawn on top
/// of the empty room is here: bodies are drawn with an alpha of 0; shadows with 0.5, and the darkest counts; pixels
/// that nobody drew are not read.
class FrameTargets {
 public:
  explicit FrameTargets(const GlFunctions& gl) : gl_(gl) {}
  ~FrameTargets();
  FrameTargets(const FrameTargets&) = delete;
  FrameTargets& operator=(const FrameTargets&) = delete;

  /// Makes drawing go into the top left `width` × `height` pixels of the attachments that are asked for: shaders for
  /// fewer of them are faster.
  void Begin(int width, int height, Targets asked);
  /// Makes rectangles, one at least, of the attachments that WriteOnly names ready to be drawn: nobody has drawn there,
  /// nothing is hidden. Drawing is then confined to about them.
  void Clear(const std::vector<PixelRect>& rects);
  /// Says which attachments the next draws write. Masks are used because a change of attachments would make Mesa finish
  /// what is drawn.
  void WriteOnly(bool colour, bool labels, bool depth);
  /// Copies what was drawn in a rectangle out of GL into the pictures of `view`, which have their size already and
  /// begin with `top_row`.
  void Read(const PixelRect& rect, int top_row, Targets targets, View& view);
  /// Copies what was drawn in a rectangle into an overlay as it is.
  void Read(const PixelRect& rect, Overlay& overlay);

 private:
  void Grow(int width, int height);
  void Release();

  const GlFunctions& gl_;
  GLuint framebuffer_ = 0;
  GLuint buffers_[4] = {};  // colour, labels, depth, hidden surfaces
  int capacity_width_ = 0, capacity_height_ = 0;
  Targets drawn_ = Targets::kAll;    ///< what the framebuffer is drawn into
  std::vector<std::uint8_t> bytes_;  // reused
  std::vector<float> depths_;
};

}  // namespace etude
