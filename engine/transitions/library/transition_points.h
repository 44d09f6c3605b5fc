#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A transition point: frame `from` of the playing clip and frame `to` of the next one, which count as one.
struct TransitionPoint {
  int from = 0;
  int to = 0;
  FuzzyDistance distance;
};

/// The frames `first` … `last` of a clip, both included; none when `last` < `first`.
struct FrameWindow {
  int first = 0;
  int last = 0;

  bool Contains(int frame) const { return first <= frame && frame <= last; }
};

/// The frames that a budget of waiting allows: from `request` to `request` + `budget_s` seconds, inside the clip.
FrameWindow WaitWindow(const TaggedClip& playing, int request, double budget_s);
/// The frames that may be entered: all but the last, after which nothing would follow.
FrameWindow EntryWindow(const TaggedClip& next);

/// Lists the frames of a window in rising order.
std::vector<int> FramesWithin(FrameWindow window);
std::vector<int> BridgeFramesWithin(const TaggedClip& clip, FrameWindow window);

/// Says whether two frames match under the rules.
bool Matches(const TaggedClip& a, int frame_a, const TaggedClip& b, int frame_b, const MatchRules& rules);

/// Paper A's search (algorithms A5): at each bridge frame of `playing` in the window, look at the bridge frames of
/// `next` that may be entered, front half first, because entering near the end looks unnatural, then rear half.
std::optional<TransitionPoint> FindTransitionPoint(const TaggedClip& playing, FrameWindow window,
                                                   const TaggedClip& next, const MatchRules& rules);

/// The ways from one clip of a library into another.
struct PairCoverage {
  double frame_share = 0;   ///< of all frames: those that match some frame of the other clip
  double bridge_share = 0;  ///< of the bridge frames: those that match one of the other's
  /// The wait from the worst frame to the next bridge frame that matches one, seconds. The clip starts over at its end,
  /// as moves do; none without such a bridge frame.
  std::optional<double> worst_wait_s;
  /// The share of frames after which no such bridge frame comes within the budget before the clip ends, so that the way
  /// leads through an in-between.
  double in_between_share = 0;
};

/// The coverage of every pair of clips of a library. `on_progress` is told of the clips whose frames are compared, each
/// counted twice: with all frames, and with the bridge frames.
class Coverage {
 public:
  Coverage(std::span<const TaggedClip> clips, const MatchRules& rules, double budget_s,
           const OnProgress& on_progress = {});

  int ClipCount() const { return clip_count_; }
  /// Returns the coverage from one clip into another one.
  const PairCoverage& Of(int from, int to) const { return pairs_[Index(from, to)]; }

  /// Paper A, section 3.5: every move needs a bridge frame into the corrective clip. The clips without one.
  std::vector<int> WithoutWayInto(int wanted) const;

 private:
  std::size_t Index(int from, int to) const { return static_cast<std::size_t>(from) * clip_count_ + to; }

  int clip_count_ = 0;
  std::vector<PairCoverage> pairs_;
};

}  // namespace etude
