#pragma once

#include <vector>

#include "sim/render/gl_context.h"
#include "sim/render/renderer.h"
#include "sim/render/touched_pixels.h"

namespace etude {

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

  /// Makes drawing go into the top left `width` × `height` pixels.
  void Begin(int width, int height);
  /// Makes rectangles, one at least, of the attachments that WriteOnly names ready to be drawn: nobody has drawn there,
  /// nothing is hidden. Drawing is then confined to about them.
  void Clear(const std::vector<PixelRect>& rects);
  /// Which of the attachments the next draws write. By masks: other attachments would make Mesa finish what is drawn.
  void WriteOnly(bool colour, bool labels, bool depth);
  /// Copies what was drawn in a rectangle out of GL into the pictures of `view`, which have their size already and
  /// begin with `top_row`.
  void Read(const PixelRect& rect, int top_row, Targets targets, View& view);

 private:
  void Grow(int width, int height);
  void Release();

  const GlFunctions& gl_;
  GLuint framebuffer_ = 0;
  GLuint buffers_[4] = {};  // colour, labels, depth, hidden surfaces
  int capacity_width_ = 0, capacity_height_ = 0;
  std::vector<std::uint8_t> bytes_;  // reused
  std::vector<float> depths_;
};

}  // namespace etude
