#include "sim/render/frame_targets.h"

#include <algorithm>
#include <cassert>

namespace etude {

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
  constexpr GLenum kFormats[] = {GL_RGBA8, GL_R32UI, GL_R32F, GL_DEPTH_COMPONENT32F};
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
  assert(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void FrameTargets::Begin(int width, int height, const RowRange& rows) {
  if (width > capacity_width_ || height > capacity_height_) Grow(width, height);
  width_ = width;
  rows_ = rows;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width, height);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(0, rows.first, width, rows.end - rows.first);
  const float farthest = 1;
  gl_.ClearBufferfv(GL_DEPTH, 0, &farthest);
}

void FrameTargets::WriteOnly(bool colour, bool labels, bool depth) {
  const GLenum none = GL_NONE;
  const GLenum buffers[] = {colour ? GL_COLOR_ATTACHMENT0 : none, labels ? GL_COLOR_ATTACHMENT1 : none,
                            depth ? GL_COLOR_ATTACHMENT2 : none};
  gl_.DrawBuffers(3, buffers);
}

View FrameTargets::Read(Targets targets) const {
  View view;
  const int height = rows_.end - rows_.first;
  view.colour = ColourImage(width_, height);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  // Four bytes a pixel are what the framebuffer holds; letting GL drop the fourth is slower.
  std::vector<std::uint8_t> rgba(view.colour.pixels.size() * 4);
  gl_.ReadPixels(0, rows_.first, width_, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  const std::uint8_t* source = rgba.data();
  for (Rgb8& pixel : view.colour.pixels) {
    pixel = {source[0], source[1], source[2]};
    source += 4;
  }
  if (targets == Targets::kColour) return view;

  view.labels = LabelImage(width_, height);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(0, rows_.first, width_, height, GL_RED_INTEGER, GL_UNSIGNED_INT, view.labels.pixels.data());
  view.depth = DepthImage(width_, height);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT2);
  gl_.ReadPixels(0, rows_.first, width_, height, GL_RED, GL_FLOAT, view.depth.pixels.data());
  return view;
}

}  // namespace etude
