#pragma once

#include <optional>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/transitions/bridge_frames/bridge_frames.h"

namespace etude {

/// Which of the matching frames is taken.
enum class Pick {
  kFirst,     ///< paper A: the first one found
  kSmallest,  ///< A's other wording ("the smallest difference"): the smallest distance in the window
};

struct SwitchRules {
  FeatureWeights weights = PaperWeights();
  double threshold = kPaperThreshold;
  Pick pick = Pick::kFirst;
  bool within_class = false;  ///< ours: compare only frames with the same ten tags
  /// Of the choices that compare point clouds: how much motion a cloud holds, half of it after the frame. Kovar,
  /// Gleicher and Pighin (2002) take about a third of a second.
  double window_s = 1.0 / 3;
  /// Of the choice that averages distances: over how much motion before the frame, and as much after it. Ours.
  double reach_s = 1.0 / 3;
  /// Of the choices that may enter any frame: what must be left to play after it, seconds; but a clip's front half may
  /// always be entered. Ours.
  double least_play_s = 1;
};

/// Two bridge frames that may be switched: `from` in the playing clip, `to` in the next one.
struct Link {
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
bool Matches(const TaggedClip& a, int frame_a, const TaggedClip& b, int frame_b, const SwitchRules& rules);

/// Paper A's search (algorithms A5): at each bridge frame of `playing` in the window, look at the bridge frames of
/// `next` that may be entered, front half first, because a switch into the tail looks unnatural, then rear half.
std::optional<Link> FindLink(const TaggedClip& playing, FrameWindow window, const TaggedClip& next,
                             const SwitchRules& rules);

}  // namespace etude
