#include "sim/render/vertex_stream.h"

#include <cassert>

namespace etude {

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
    // NOLINTNEXTLINE(performance-no-int-to-ptr): what GL calls a pointer is an offset into the buffer
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

void VertexStream::Draw() const {
  gl_.BindVertexArray(vertices_);
  if (strip_length_ > 0) {
    gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, strip_length_, count_);
  } else {
    gl_.DrawArrays(GL_TRIANGLES, 0, count_);
  }
}

void VertexStream::DrawSome(std::size_t first, std::size_t count) const {
  assert(strip_length_ == 0 && first + count <= static_cast<std::size_t>(count_));
  gl_.BindVertexArray(vertices_);
  gl_.DrawArrays(GL_TRIANGLES, static_cast<GLint>(first), static_cast<GLsizei>(count));
}

}  // namespace etude
