#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "engine/base/image.h"
#include "sim/render/gl_context.h"
#include "sim/render/scene.h"

namespace etude {

/// The vertex data of one draw call, uploaded for every picture. An element is a corner of a triangle, or an instance
/// of a triangle strip whose corners the shader computes. The GL context must outlive this object.
class VertexStream {
 public:
  /// An input of the shader: `size` floats, which begin `offset` bytes into an element. Locations are numbered from 0
  /// in order.
  struct Attribute {
    int size;
    std::size_t offset;
  };
  /// Makes the vertex array. If each element is an instance of a triangle strip, `strip_length` is the number of
  /// corners of the strip; if elements are corners, it is 0.
  VertexStream(const GlFunctions& gl, std::size_t element_bytes, GLsizei strip_length,
               std::initializer_list<Attribute> attributes);

  template <typename Element>
  void Upload(const std::vector<Element>& elements) {
    Upload(elements.data(), elements.size(), sizeof(Element));
  }
  /// Uploads corners and the `indices` of the triangles that use them.
  template <typename Element>
  void Upload(const std::vector<Element>& elements, const std::vector<std::uint32_t>& indices) {
    Upload(elements.data(), elements.size(), sizeof(Element));
    Index(indices);
  }
  bool IsEmpty() const { return count_ == 0; }
  void Draw() const;
  /// Draws `count` indices, beginning with index number `first`; only for streams of corners.
  void DrawSome(std::size_t first, std::size_t count) const;

 private:
  void Upload(const void* data, std::size_t count, std::size_t element_bytes);
  void Index(const std::vector<std::uint32_t>& indices);

  const GlFunctions& gl_;
  GLsizei strip_length_;
  GLsizei count_ = 0;  ///< number of instances or indices
  GLuint vertices_ = 0;
  GLuint buffer_ = 0, indices_ = 0;
};

/// Holds the textures that were uploaded to GL. A figure's textures are kept from picture to picture. The GL context
/// must outlive this object.
class TextureStore {
 public:
  /// The texture unit to which Bind binds; unit 0 holds the room's texture.
  static constexpr GLint kUnit = 1;

  explicit TextureStore(const GlFunctions& gl) : gl_(gl) {}

  /// Binds a texture to the unit. A new texture is first uploaded, with mipmaps.
  void Bind(const SharedTexture& texture);

 private:
  // `texture` is a shared pointer that keeps the texture alive; otherwise another texture could get the same address.
  struct Uploaded {
    SharedTexture texture;
    GLuint name = 0;
  };

  GLuint UploadTexture(const Texture& texture) const;

  const GlFunctions& gl_;
  std::vector<Uploaded> uploaded_;
};

/// The framebuffer into which pictures are drawn: colour, labels, linear depth, and a depth buffer for hidden surfaces.
/// The framebuffer grows to the size of the largest picture; smaller pictures use its corner. It holds only what is
/// drawn over the empty room. Bodies are drawn with an alpha of 0 and shadows with 0.5; where shadows overlap, the
/// darkest counts. Pixels that were not drawn are not read.
class FrameTargets {
 public:
  explicit FrameTargets(const GlFunctions& gl) : gl_(gl) {}
  ~FrameTargets();
  FrameTargets(const FrameTargets&) = delete;
  FrameTargets& operator=(const FrameTargets&) = delete;

  /// Directs drawing to the top left `width` × `height` pixels of the requested attachments. Fewer attachments are
  /// faster.
  void Begin(int width, int height, Targets asked);
  /// Clears rectangles (at least one) of the attachments selected by WriteOnly: their pixels then count as not drawn.
  /// From then on, drawing is limited to the bounding rectangle of `rects`.
  void Clear(const std::vector<PixelRect>& rects);
  /// Selects the attachments that the next draw calls write. This uses colour masks, because a change of attachments
  /// would make Mesa finish all pending drawing.
  void WriteOnly(bool colour, bool labels, bool depth);
  /// Copies the drawn pixels of a rectangle from GL to the pictures of `view`, which must have their size already. The
  /// first row of `view` is row `top_row` of the picture.
  void Read(const PixelRect& rect, int top_row, Targets targets, View& view);
  /// Copies the drawn pixels of a rectangle from GL to an overlay, unchanged.
  void Read(const PixelRect& rect, Overlay& overlay);

 private:
  void Grow(int width, int height);
  void Release();

  const GlFunctions& gl_;
  GLuint framebuffer_ = 0;
  GLuint buffers_[4] = {};  // colour, labels, depth, hidden surfaces
  int capacity_width_ = 0, capacity_height_ = 0;
  Targets drawn_ = Targets::kAll;    ///< the attachments that Begin selected
  std::vector<std::uint8_t> bytes_;  // memory reused from picture to picture
  std::vector<float> depths_;
};

}  // namespace etude
