#pragma once

#include <span>
#include <vector>

#include "engine/transitions/search/grade_blocks.h"

namespace etude {

/// Frames in time order, sixteen to a block, and the box of every block: frames in a row are close to each other, so
/// most blocks are seen to be far as a whole.
struct TimeBlocks {
  TimeBlocks() = default;
  explicit TimeBlocks(std::span<const Grades> frames);

  int frame_count = 0;
  std::vector<FrameBlock> frames;
  std::vector<BoxBlock> boxes;  ///< boxes[i] are those of frames[16 i] …

  int BlockCount() const { return static_cast<int>(frames.size()); }
};

}  // namespace etude
