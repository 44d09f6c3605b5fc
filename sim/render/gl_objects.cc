#include "sim/render/gl_objects.h"

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

constexpr std::uint8_t kUndrawnAlpha = Overlay::kNothing, kUndrawnLabel = 255;
static_assert(static_cast<int>(Part::kBystander) < kUndrawnLabel);

Rgb8 Darkest(const Rgb8& a, const Rgb8& b) { return {std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)}; }

}  // namespace

VertexStream::VertexStream(const GlFunctions& gl, std::size_t element_bytes, GLsizei strip_length,
                           std::initializer_list<Attribute> attributes)
    : gl_(gl), strip_length_(strip_length) {
  gl.GenVertexArrays(1, &vertices_);
  gl.GenBuffers(1, &buffer_);
  gl.BindVertexArray(vertices_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  GLuint location = 0;
  for (const Attribute& attribute : attributes) {
    gl.EnableVertexAttribArray(location);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): this argument is a pointer in GL's interface, but its value is an
    // offset into the buffer
    const void* pointer = reinterpret_cast<const void*>(attribute.offset);
    gl.VertexAttribPointer(location, attribute.size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(element_bytes), pointer);
    gl.VertexAttribDivisor(location, strip_length > 0 ? 1 : 0);
    ++location;
  }
}

void VertexStream::Upload(const void* data, std::size_t count, std::size_t element_bytes) {
  count_ = static_cast<GLsizei>(count);
  if (IsEmpty()) return;
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * element_bytes), data, GL_STREAM_DRAW);
}

void VertexStream::Index(const std::vector<std::uint32_t>& indices) {
  count_ = static_cast<GLsizei>(indices.size());
  if (IsEmpty()) return;
  if (indices_ == 0) gl_.GenBuffers(1, &indices_);
  gl_.BindVertexArray(vertices_);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STREAM_DRAW);
}

void VertexStream::Draw() const {
  if (strip_length_ == 0) return DrawSome(0, static_cast<std::size_t>(count_));
  gl_.BindVertexArray(vertices_);
  gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, strip_length_, count_);
}

void VertexStream::DrawSome(std::size_t first, std::size_t count) const {
  assert(strip_length_ == 0 && first + count <= static_cast<std::size_t>(count_));
  gl_.BindVertexArray(vertices_);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): again, the pointer is an offset into the buffer
  const void* begin = reinterpret_cast<const void*>(first * sizeof(std::uint32_t));
  gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT, begin);
}

void TextureStore::Bind(const SharedTexture& texture) {
  gl_.ActiveTexture(GL_TEXTURE0 + kUnit);
  auto found = std::ranges::find(uploaded_, texture, &Uploaded::texture);
  if (found != uploaded_.end()) {
    gl_.BindTexture(GL_TEXTURE_2D, found->name);
  } else {
    constexpr std::size_t kMaxKept = 64;
    if (uploaded_.size() == kMaxKept) {
      for (const Uploaded& old : uploaded_) gl_.DeleteTextures(1, &old.name);
      uploaded_.clear();
    }
    uploaded_.push_back({texture, UploadTexture(*texture)});
  }
  gl_.ActiveTexture(GL_TEXTURE0);
}

GLuint TextureStore::UploadTexture(const Texture& texture) const {
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

FrameTargets::~FrameTargets() { Release(); }

void FrameTargets::Release() {
  if (framebuffer_ == 0) return;
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteRenderbuffers(4, buffers_);
}

void FrameTargets::Grow(int width, int height) {
  Release();
  capacity_width_ = std::max(width, capacity_width_);
  capacity_height_ = std::max(height, capacity_height_);
  constexpr GLenum kFormats[] = {GL_RGBA8, GL_R8UI, GL_R32F, GL_DEPTH_COMPONENT32F};
  constexpr GLenum kAttachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2,
                                     GL_DEPTH_ATTACHMENT};
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.GenRenderbuffers(4, buffers_);
  for (int i = 0; i < 4; ++i) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffers_[i]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, kFormats[i], capacity_width_, capacity_height_);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, kAttachments[i], GL_RENDERBUFFER, buffers_[i]);
  }
  gl_.DrawBuffers(3, kAttachments);
  drawn_ = Targets::kAll;
  assert(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void FrameTargets::Begin(int width, int height, Targets asked) {
  if (width > capacity_width_ || height > capacity_height_) Grow(width, height);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  if (asked != drawn_) {
    constexpr GLenum kAttachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    gl_.DrawBuffers(asked == Targets::kColour ? 1 : asked == Targets::kAll ? 3 : 2, kAttachments);
    drawn_ = asked;
  }
  gl_.Viewport(0, 0, width, height);
}

void FrameTargets::Clear(const std::vector<PixelRect>& rects) {
  constexpr GLfloat kNothing[] = {1, 1, 1, 1}, kNoDepth[] = {0, 0, 0, 0}, kMaxDepth[] = {1};
  constexpr GLuint kNoLabel[] = {kUndrawnLabel, 0, 0, 0};
  gl_.Enable(GL_SCISSOR_TEST);
  PixelRect all = rects.front();
  for (const PixelRect& rect : rects) {
    all = {std::min(all.left, rect.left), std::min(all.top, rect.top), std::max(all.right, rect.right),
           std::max(all.bottom, rect.bottom)};
    gl_.Scissor(rect.left, rect.top, rect.Width(), rect.Height());
    gl_.ClearBufferfv(GL_COLOR, 0, kNothing);
    gl_.ClearBufferuiv(GL_COLOR, 1, kNoLabel);
    gl_.ClearBufferfv(GL_COLOR, 2, kNoDepth);
    gl_.ClearBufferfv(GL_DEPTH, 0, kMaxDepth);
  }
  gl_.Scissor(all.left, all.top, all.Width(), all.Height());
}

void FrameTargets::WriteOnly(bool colour, bool labels, bool depth) {
  const bool writes[] = {colour, labels, depth};
  for (GLuint i = 0; i < 3; ++i) {
    const GLboolean write = writes[i] ? GL_TRUE : GL_FALSE;
    gl_.ColorMaski(i, write, write, write, write);
  }
}

void FrameTargets::Read(const PixelRect& rect, int top_row, Targets targets, View& view) {
  const int width = rect.Width();
  const std::size_t pixels = static_cast<std::size_t>(width) * rect.Height();
  // Read colours: bodies replace the view's pixels, shadows darken them.
  bytes_.resize(4 * pixels);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  // Read four bytes per pixel as the framebuffer holds them; a conversion to three bytes would be slower.
  gl_.ReadPixels(rect.left, rect.top, width, rect.Height(), GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
  CheckMemory(gl_);
  const std::uint8_t* source = bytes_.data();
  for (int y = rect.top; y < rect.bottom; ++y) {
    Rgb8* row = &view.colour.At(rect.left, y - top_row);
    for (int x = 0; x < width; ++x, source += 4) {
      if (source[3] == kUndrawnAlpha) continue;
      const Rgb8 drawn{source[0], source[1], source[2]};
      row[x] = source[3] == 0 ? drawn : Darkest(drawn, row[x]);
    }
  }
  if (targets == Targets::kColour) return;

  // Read labels.
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(rect.left, rect.top, width, rect.Height(), GL_RED_INTEGER, GL_UNSIGNED_BYTE, bytes_.data());
  CheckMemory(gl_);
  for (int y = 0; y < rect.Height(); ++y) {
    const std::uint8_t* labels = &bytes_[static_cast<std::size_t>(y) * width];
    std::uint32_t* row = &view.labels.At(rect.left, rect.top + y - top_row);
    for (int x = 0; x < width; ++x) row[x] = labels[x] == kUndrawnLabel ? row[x] : labels[x];
  }
  if (targets == Targets::kColourAndLabels) return;

  // Read depths.
  depths_.resize(pixels);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT2);
  gl_.ReadPixels(rect.left, rect.top, width, rect.Height(), GL_RED, GL_FLOAT, depths_.data());
  CheckMemory(gl_);
  for (int y = 0; y < rect.Height(); ++y) {
    const float* depths = &depths_[static_cast<std::size_t>(y) * width];
    float* row = &view.depth.At(rect.left, rect.top + y - top_row);
    for (int x = 0; x < width; ++x) row[x] = depths[x] == 0 ? row[x] : depths[x];
  }
}

void FrameTargets::Read(const PixelRect& rect, Overlay& overlay) {
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.PixelStorei(GL_PACK_ROW_LENGTH, overlay.width);
  gl_.ReadPixels(rect.left, rect.top, rect.Width(), rect.Height(), GL_RGBA, GL_UNSIGNED_BYTE,
                 &overlay.bytes[4 * (static_cast<std::size_t>(rect.top) * overlay.width + rect.left)]);
  gl_.PixelStorei(GL_PACK_ROW_LENGTH, 0);
  CheckMemory(gl_);
}

}  // namespace etude
