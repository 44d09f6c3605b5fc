#pragma once

#include <optional>
#include <span>

#include "engine/bridging/switching.h"

namespace etude {

/// How long the in-between may be; ours.
struct InBetweenRules {
  int min_frames = 10;  ///< shorter ones are two cuts in a row, not a motion
  int max_frames = 60;  ///< 2 s at 30 Hz
};

/// A way from one clip into another through a piece of a third (paper A's in-between motion, 補間動作,
/// a run of bridge frames' clips): `enter` switches into clip `through`, `leave` out of it.
struct InBetween {
  int through = 0;
  Link enter;
  Link leave;
};

struct InBetweenSearch {
  std::optional<InBetween> found;
  int pairs_seen = 0;
};

/// The first in-between there is: at each bridge frame of `playing` in the window, through each other
/// clip of the library in order, entering as early and staying as briefly as the rules allow.
InBetweenSearch FindInBetween(std::span<const TaggedClip> library, int playing, FrameWindow window, int next,
                              const SwitchRules& rules, const InBetweenRules& in_between = {});

}  // namespace etude
