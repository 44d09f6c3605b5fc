#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/transitions/search/grade_index.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A clip whose frames are compared with those of other clips. The spans must stay valid.
struct MatchClip {
  std::span<const Grades> grades;  ///< one per frame
  /// The participating frames (bridge frames) in rising order; empty optional: all.
  std::optional<std::span<const int>> frames = std::nullopt;
  std::span<const Tags> tags = {};  ///< one per frame; read only if `within_class`
};

/// The matches (d < threshold) of one frame in another clip.
struct FrameMatches {
  int frame = 0;        ///< index in the clip that is left
  int first = 0;        ///< the first match in time order, as in paper A's "front half, then rear half"
  int nearest = 0;      ///< the nearest match; the earlier one on a tie
  double distance = 0;  ///< distance of the nearest match
};

/// The first and the nearest match of every frame in every other clip.
class MatchTable {
 public:
  int ClipCount() const { return static_cast<int>(asked_.size()); }
  /// Returns the number of a clip's participating frames.
  int QueryFrames(int clip) const { return asked_[static_cast<std::size_t>(clip)]; }
  /// Returns the frames of clip `from` that match a frame of clip `to`, in rising order; none if they are the same
  /// clip.
  std::span<const FrameMatches> Of(int from, int to) const { return found_[Pair(from, to)]; }
  /// Returns the entry of the reachability matrix: the share of `from`'s participating frames that match a frame of
  /// `to`, in [0, 1]; 0 if none participated.
  double Share(int from, int to) const;

 private:
  friend MatchTable FindMatches(std::span<const MatchClip> clips, const MatchRules& rules, SearchWork* work,
                                const OnProgress& on_progress);
  std::size_t Pair(int from, int to) const { return static_cast<std::size_t>(from) * asked_.size() + to; }

  std::vector<int> asked_;
  std::vector<std::vector<FrameMatches>> found_;  // indexed by Pair
};

/// Compares every clip's frames with those of every other clip; `rules.pick` has no effect. A clip's last frame is
/// never a match, because it has no next frame. The search is exact, as in GradeIndex. `on_progress` receives the
/// number of finished clips.
MatchTable FindMatches(std::span<const MatchClip> clips, const MatchRules& rules = {}, SearchWork* work = nullptr,
                       const OnProgress& on_progress = {});

}  // namespace etude
