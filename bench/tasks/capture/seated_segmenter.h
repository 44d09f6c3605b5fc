#pragma once

#include <optional>

#include "bench/tasks/base/task.h"
#include "engine/base/image.h"

namespace etude {

/// A program that finds the person in the pictures of a take (docs/outside-methods.md): a session for every camera, a
/// step for every picture.
class SeatedSegmenter {
 public:
  /// `program` must outlive this.
  explicit SeatedSegmenter(LiveProgram& program) : program_(program) {}

  /// The next pictures are this camera's, of that empty room.
  void Begin(std::size_t camera, const ColourImage& background);
  /// The mask of what the program says has changed in the next picture. All zero when it has failed, or complained:
  /// then nothing more is asked.
  Mask Detect(const ColourImage& picture);

  /// The complaint about an answer; success when there was none.
  const Result<void>& complaint() const { return complaint_; }

 private:
  LiveProgram& program_;
  Result<void> complaint_;
  bool goes_on_ = true;
  std::size_t camera_ = 0, frame_ = 0;
};

}  // namespace etude
