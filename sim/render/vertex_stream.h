#pragma once

#include <initializer_list>
#include <vector>

#include "sim/render/gl_context.h"

namespace etude {

/// What one draw reads, sent anew for every picture: corners of triangles, or instances of one triangle strip whose
/// corners the shader makes up. Lives as long as its context.
class VertexStream {
 public:
  /// One input of the shader: `size` floats, `offset` bytes into an element. The first has location 0, and so on.
  struct Attribute {
    int size;
    std::size_t offset;
  };
  /// `strip_length` = corners of the strip that each element stands for; 0 when elements are corners.
  VertexStream(const GlFunctions& gl, std::size_t element_bytes, GLsizei strip_length,
               std::initializer_list<Attribute> attributes);

  template <typename Element>
  void Upload(const std::vector<Element>& elements) {
    Upload(elements.data(), elements.size(), sizeof(Element));
  }
  bool IsEmpty() const { return count_ == 0; }
  void Draw() const;
  /// Only `count` corners from `first` on; of streams of corners.
  void DrawSome(std::size_t first, std::size_t count) const;

 private:
  void Upload(const void* data, std::size_t count, std::size_t element_bytes);

  const GlFunctions& gl_;
  GLsizei strip_length_;
  GLsizei count_ = 0;
  GLuint vertices_ = 0;
  GLuint buffer_ = 0;
};

}  // namespace etude
