#pragma once

#include <optional>
#include <vector>

#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A transition point: frame `to` of the next clip replaces frame `from` of the playing clip.
struct TransitionPoint {
  int from = 0;
  int to = 0;
  FuzzyDistance distance;
};

/// The frames from `first` to `last` of a clip, both included; empty if `last` < `first`.
struct FrameWindow {
  int first = 0;
  int last = 0;

  bool Contains(int frame) const { return first <= frame && frame <= last; }
};

/// Returns the frames within the budget: from `request` to `request` + `budget_s` seconds, limited to the clip.
FrameWindow WaitWindow(const TaggedClip& playing, int request, double budget_s);
/// Returns the frames that may be entered: all except the last, because nothing of the clip would follow it.
FrameWindow EntryWindow(const TaggedClip& next);

/// Returns the frames of a window in ascending order.
std::vector<int> FramesWithin(FrameWindow window);
std::vector<int> BridgeFramesWithin(const TaggedClip& clip, FrameWindow window);

/// Returns true if frame `frame_a` of `a` and frame `frame_b` of `b` match under the rules.
bool Matches(const TaggedClip& a, int frame_a, const TaggedClip& b, int frame_b, const MatchRules& rules);

/// Searches as in paper A. Each bridge frame of `playing` in the window is compared with the bridge
/// frames of `next` that may be entered. Frames of the front half come first, because entering a clip near its end
/// looks unnatural. Returns nullopt if no pair matches.
std::optional<TransitionPoint> FindTransitionPoint(const TaggedClip& playing, FrameWindow window,
                                                   const TaggedClip& next, const MatchRules& rules);

}  // namespace etude
