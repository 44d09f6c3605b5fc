#pragma once

#include <string>
#include <vector>

#include "engine/transitions/tags_file/bridge_tags.h"

namespace etude {

/// What two sets of tags have in common, and what not.
struct TagsComparison {
  std::vector<std::string> differences;  ///< one line each
  int clips = 0;                         ///< in both
  int bridge_frames = 0;                 ///< in both
};

/// Holds the tags of a file against those that its clips have now: rules, clips, frames and keys must be the same,
/// grades and differences to 10⁻⁹.
TagsComparison CompareTags(const BridgeTags& file, const BridgeTags& now);

}  // namespace etude
