#pragma once

#include <span>
#include <vector>

#include "engine/transitions/search/grade_blocks.h"

namespace etude {

/// The numbers of all frames, so ordered that every `kBlockLanes` in a row are close to each other, and likewise every
/// sixteen such blocks, and so on: a k-d tree whose leaves are the blocks. Within a block in time order.
std::vector<int> OrderForBlocks(std::span<const Grades> frames, const GradeMetric& metric);

}  // namespace etude
