#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A joint is the mean of some markers, all of which must be present.
struct MarkerRule {
  Role role;
  std::vector<std::string> markers;
};

/// A convention of marker names, in lower case.
struct MarkerSet {
  std::string name;
  std::vector<MarkerRule> rules;
  std::array<std::string, 4> pelvis = {};  ///< left and right front, left and right back; the hips follow from them
  bool is_gait = false;                    ///< knees, ankles and shoulders have one marker each, on the skin
};

/// Lists the supported conventions.
const std::vector<MarkerSet>& MarkerSets();

}  // namespace etude
