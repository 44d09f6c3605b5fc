#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/transitions/bridge_frames/bridge_frames.h"
#include "engine/transitions/bridge_frames/transition_points.h"

namespace etude {

/// How well one clip of a library leads into another.
struct PairCoverage {
  double frame_share = 0;   ///< of all frames: those that match some frame of the other clip
  double bridge_share = 0;  ///< of the bridge frames: those that match one of the other's
  /// From the worst frame to the next bridge frame that matches one, seconds. The clip starts over at its end, as
  /// moves do; none without such a bridge frame.
  std::optional<double> worst_wait_s;
  /// Of all frames: those from which no such bridge frame comes within the budget before the clip ends, so that the
  /// way leads through an in-between.
  double in_between_share = 0;
};

/// The same of every pair of clips of a library. `on_progress` is told of the clips whose frames are compared, each
/// counted twice: with all frames, and with the bridge frames.
class Coverage {
 public:
  Coverage(std::span<const TaggedClip> clips, const MatchRules& rules, double budget_s,
           const OnProgress& on_progress = {});

  int ClipCount() const { return clip_count_; }
  /// From one clip into another one.
  const PairCoverage& Of(int from, int to) const { return pairs_[Index(from, to)]; }

  /// Paper A, section 3.5: every move needs a bridge frame into the corrective clip. The clips without one.
  std::vector<int> WithoutWayInto(int wanted) const;

 private:
  std::size_t Index(int from, int to) const { return static_cast<std::size_t>(from) * clip_count_ + to; }

  int clip_count_ = 0;
  std::vector<PairCoverage> pairs_;
};

}  // namespace etude
