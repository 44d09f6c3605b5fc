#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A joint is the middle of some markers, all of them.
struct MarkerRule {
  Role role;
  std::vector<std::string> markers;
};

/// A convention of names, in small letters.
struct MarkerSet {
  std::string name;
  std::vector<MarkerRule> rules;
  std::array<std::string, 4> pelvis = {};  ///< left and right, front and back; the hips follow from them
  bool is_gait = false;                    ///< knees, ankles and shoulders have one marker, at the skin
};

/// The conventions that are known here.
const std::vector<MarkerSet>& MarkerSets();

}  // namespace etude
