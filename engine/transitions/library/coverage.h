#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// The shares of one clip's frames that match a frame of another clip. `Coverage::Of` returns the shares for one
/// other clip, `Coverage::IntoAny` for all other clips of the library together.
struct ClipCoverage {
  double frame_share = 0;   ///< share of all frames that match a frame of the other clip
  double bridge_share = 0;  ///< share of the bridge frames that match a bridge frame of the other clip
  /// The longest wait from any frame to the next matching bridge frame, in seconds, if the clip is played in a loop;
  /// nullopt if no bridge frame matches.
  std::optional<double> worst_wait_s;
  /// The share of frames after which no matching bridge frame follows within the budget and before the clip's end. A
  /// transition from such a frame goes through an in-between.
  double in_between_share = 0;
};

/// Selects the coverages to compute. The time and memory for pairs grow with the square of the library's size.
struct CoverageOptions {
  double budget_s = 1;             ///< maximal wait before a transition, seconds
  bool with_pairs = true;          ///< also compute Coverage::Of
  std::vector<int> wanted = {};    ///< clips for which WithoutWayInto is computed; all if `with_pairs`
  /// Receives the number of steps done so far, and their total. Each clip takes two steps, with `with_pairs` three.
  OnProgress on_progress = {};
};

/// The coverage of every clip of a library. A clip's last frame is never a match, because it has no next frame.
class Coverage {
 public:
  Coverage(std::span<const TaggedClip> clips, const MatchRules& rules, const CoverageOptions& options = {});

  int ClipCount() const { return static_cast<int>(any_.size()); }
  /// Returns the coverage of a clip by all other clips together.
  const ClipCoverage& IntoAny(int from) const { return any_[static_cast<std::size_t>(from)]; }
  bool HasPairs() const { return !pairs_.empty(); }
  /// Returns the coverage of clip `from` by clip `to`. Requires CoverageOptions::with_pairs.
  const ClipCoverage& Of(int from, int to) const { return pairs_[Pair(from, to)]; }

  /// Returns the clips that have no bridge frame matching a bridge frame of clip `wanted`. Paper A (section 3.5)
  /// demands that every move has a matching bridge frame for the corrective clip.
  const std::vector<int>& WithoutWayInto(int wanted) const { return without_.at(wanted); }

 private:
  std::size_t Pair(int from, int to) const { return static_cast<std::size_t>(from) * any_.size() + to; }
  void ComputePairs(std::span<const TaggedClip> clips, const MatchRules& rules, const CoverageOptions& options);

  std::vector<ClipCoverage> any_;
  std::vector<ClipCoverage> pairs_;
  std::map<int, std::vector<int>> without_;
};

}  // namespace etude
