#pragma once

#include <optional>
#include <vector>

#include "engine/transitions/base/match_rules.h"
#include "engine/transitions/bridge_frames/bridge_frames.h"

namespace etude {

/// A transition point: frame `from` of the playing clip and frame `to` of the next one, which count as one.
struct TransitionPoint {
  int from = 0;
  int to = 0;
  FuzzyDistance distance;
};

/// Frames `first` … `last` of a clip, both included; none when `last` < `first`.
struct FrameWindow {
  int first = 0;
  int last = 0;

  bool Contains(int frame) const { return first <= frame && frame <= last; }
};

/// The frames that a budget of waiting allows: from `request` to `request` + `budget_s` seconds, inside the clip.
FrameWindow WaitWindow(const TaggedClip& playing, int request, double budget_s);
/// The frames that may be entered: all but the last, after which nothing would follow.
FrameWindow EntryWindow(const TaggedClip& next);

/// In rising order.
std::vector<int> FramesWithin(FrameWindow window);
std::vector<int> BridgeFramesWithin(const TaggedClip& clip, FrameWindow window);

/// Whether two frames match under the rules.
bool Matches(const TaggedClip& a, int frame_a, const TaggedClip& b, int frame_b, const MatchRules& rules);

/// Paper A's search (algorithms A5): at each bridge frame of `playing` in the window, look at the bridge frames of
/// `next` that may be entered, front half first, because entering near the end looks unnatural, then rear half.
std::optional<TransitionPoint> FindTransitionPoint(const TaggedClip& playing, FrameWindow window,
                                                   const TaggedClip& next, const MatchRules& rules);

}  // namespace etude
