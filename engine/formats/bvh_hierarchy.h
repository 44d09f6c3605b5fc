#pragma once

#include <vector>

#include "engine/base/result.h"
#include "engine/formats/text_scanner.h"
#include "engine/motion/clip.h"

namespace etude {

/// What one number of a BVH frame drives.
struct BvhChannel {
  int joint = 0;
  bool is_rotation = false;
  int axis = 0;  ///< 0, 1, 2 = X, Y, Z
};

/// The upper half of a BVH file.
struct BvhHierarchy {
  Skeleton skeleton;
  std::vector<BvhChannel> channels;  ///< in the order of a frame's numbers
};

/// Reads from the start of the file up to and including the word MOTION.
Result<BvhHierarchy> ReadBvhHierarchy(TextScanner& scanner);

/// Whether two words are the same but for upper and lower case (ASCII).
bool SameWord(std::string_view a, std::string_view b);

}  // namespace etude
