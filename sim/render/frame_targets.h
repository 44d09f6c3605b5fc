#pragma once

#include "sim/render/gl_context.h"
#include "sim/render/renderer.h"

namespace etude {

/// The framebuffer that pictures are drawn into: colour, labels, linear depth, and a depth buffer for
/// hidden surfaces. It grows to the largest picture asked for; smaller ones use its corner.
class FrameTargets {
 public:
  explicit FrameTargets(const GlFunctions& gl) : gl_(gl) {}
  ~FrameTargets();
  FrameTargets(const FrameTargets&) = delete;
  FrameTargets& operator=(const FrameTargets&) = delete;

  /// Makes drawing go into those rows of the top left `width` × `height` pixels, depth buffer cleared there.
  void Begin(int width, int height, const RowRange& rows);
  /// Which of the attachments the next draws write.
  void WriteOnly(bool colour, bool labels, bool depth);
  /// Copies the rows drawn since `Begin` out of GL.
  View Read(Targets targets) const;

 private:
  void Grow(int width, int height);
  void Release();

  const GlFunctions& gl_;
  GLuint framebuffer_ = 0;
  GLuint buffers_[4] = {};  // colour, labels, depth, hidden surfaces
  int capacity_width_ = 0, capacity_height_ = 0;
  int width_ = 0;
  RowRange rows_;
};

}  // namespace etude
