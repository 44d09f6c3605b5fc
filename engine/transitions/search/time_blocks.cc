#include "engine/transitions/search/time_blocks.h"

#include <algorithm>

namespace etude {

TimeBlocks::TimeBlocks(std::span<const Grades> all) : frame_count(static_cast<int>(all.size())) {
  frames.resize(static_cast<std::size_t>(BlocksFor(all.size())));
  boxes.resize(static_cast<std::size_t>(BlocksFor(frames.size())));
  for (std::size_t b = 0; b < frames.size(); ++b) {
    const std::span<const Grades> own =
        all.subspan(b * kBlockLanes).first(std::min<std::size_t>(kBlockLanes, all.size() - b * kBlockLanes));
    for (std::size_t i = 0; i < own.size(); ++i) frames[b].Set(static_cast<int>(i), own[i]);
    boxes[b / kBlockLanes].Set(static_cast<int>(b % kBlockLanes), BoxOf(own));
  }
}

}  // namespace etude
