#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A transition point: frame `from` of the playing clip, which frame `to` of the next clip replaces.
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

/// Returns the frames within the waiting budget: from `request` to `request` + `budget_s` seconds, limited to the clip.
FrameWindow WaitWindow(const TaggedClip& playing, int request, double budget_s);
/// Returns the frames that may be entered: all except the last, which has no next frame.
FrameWindow EntryWindow(const TaggedClip& next);

/// Returns the frames of a window in rising order.
std::vector<int> FramesWithin(FrameWindow window);
std::vector<int> BridgeFramesWithin(const TaggedClip& clip, FrameWindow window);

/// Returns true if two frames match under the rules.
bool Matches(const TaggedClip& a, int frame_a, const TaggedClip& b, int frame_b, const MatchRules& rules);

/// Searches as paper A does (algorithms A5): each bridge frame of `playing` in the window is compared with the bridge
/// frames of `next` that may be entered, those of the front half first, because entering a clip near its end looks
/// unnatural. Returns nothing if no pair matches.
std::optional<TransitionPoint> FindTransitionPoint(const TaggedClip& playing, FrameWindow window,
                                                   const TaggedClip& next, const MatchRules& rules);

/// Statistics of the transitions from one clip of a library into another.
struct PairCoverage {
  double frame_share = 0;   ///< share of all frames that match some frame of the other clip
  double bridge_share = 0;  ///< share of the bridge frames that match some bridge frame of the other clip
  /// The longest wait from any frame to the next matching bridge frame, in seconds, if the clip is repeated at its end;
  /// empty if there is no such bridge frame.
  std::optional<double> worst_wait_s;
  /// The share of frames from which no matching bridge frame is reached within the budget and before the clip's end, so
  /// that a transition goes through an in-between.
  double in_between_share = 0;
};

/// The coverage of every pair of clips of a library. `on_progress` receives the number of compared clips; each clip
/// counts twice, once with all frames and once with the bridge frames.
class Coverage {
 public:
  Coverage(std::span<const TaggedClip> clips, const MatchRules& rules, double budget_s,
           const OnProgress& on_progress = {});

  int ClipCount() const { return clip_count_; }
  /// Returns the coverage from one clip into another one.
  const PairCoverage& Of(int from, int to) const { return pairs_[Index(from, to)]; }

  /// Returns the clips without a bridge frame that matches one of clip `wanted`. Paper A (section 3.5) demands that
  /// every move has one into the corrective clip.
  std::vector<int> WithoutWayInto(int wanted) const;

 private:
  std::size_t Index(int from, int to) const { return static_cast<std::size_t>(from) * clip_count_ + to; }

  int clip_count_ = 0;
  std::vector<PairCoverage> pairs_;
};

}  // namespace etude
