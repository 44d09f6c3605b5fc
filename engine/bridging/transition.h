#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/bridging/in_between.h"
#include "engine/bridging/switching.h"

namespace etude {

/// When and where to leave the playing clip.
enum class Choice {
  kFuzzyBridge,  ///< paper A's
  kNow,          ///< at once, into the next clip's first frame
  kWaitForEnd,   ///< after the playing clip's last frame, into the next clip's first
};

/// Which way a transition took.
enum class Branch { kNone, kNow, kEnd, kFrontHalf, kRearHalf, kInBetween };
/// "none", "now", "end", "front half", "rear half", "in-between".
std::string_view BranchName(Branch branch);

/// One switch of clips: frame `from_frame` of one is frame `to_frame` of the other, so that what is
/// seen next is `to_frame` + 1.
struct Switch {
  int from_clip = 0;
  int from_frame = 0;
  int to_clip = 0;
  int to_frame = 0;
  FuzzyDistance distance;
};

/// How to get from one clip into another, and how that was found.
struct Transition {
  Branch branch = Branch::kNone;
  std::vector<Switch> switches;  ///< in order; none when there is no way, two through an in-between
  int request_frame = 0;         ///< of the clip that was playing
  int pairs_seen = 0;            ///< pairs of bridge frames compared on the way
  double wait_s = 0;             ///< from the request until the wanted clip plays
};

/// Plans the way from clip `from`, at frame `request_frame`, into clip `to` of the library. The clips'
/// distances are recorded whatever the choice. `to` must have two frames.
Transition PlanTransition(std::span<const TaggedClip> library, int from, int request_frame, int to, Choice choice,
                          const SwitchRules& rules);

}  // namespace etude
