#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/transitions/search/grade_index.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A clip whose frames are compared with those of others. The caller keeps what the spans show.
struct MatchClip {
  std::span<const Grades> grades;                             ///< one per frame
  std::optional<std::span<const int>> frames = std::nullopt;  ///< those that take part (bridge frames), rising; or all
  std::span<const Tags> tags = {};                            ///< one per frame; only read `within_class`
};

/// The frames of another clip that match a frame: d < threshold.
struct FrameMatches {
  int frame = 0;        ///< of the clip that is left
  int first = 0;        ///< the first match in time order: paper A's "front half, then rear half"
  int nearest = 0;      ///< the nearest match; the first of several
  double distance = 0;  ///< of the nearest
};

/// Every frame's first and nearest match in every other clip.
class MatchTable {
 public:
  int ClipCount() const { return static_cast<int>(asked_.size()); }
  /// Returns how many frames of a clip took part.
  int AskedFrames(int clip) const { return asked_[static_cast<std::size_t>(clip)]; }
  /// The frames of clip `from` that match a frame of clip `to`, rising; none when both are the same clip.
  std::span<const FrameMatches> Of(int from, int to) const { return found_[Pair(from, to)]; }
  /// The reachability matrix: the share of `from`'s frames that took part that match one of `to`, in [0, 1]; 0 when
  /// none did.
  double Share(int from, int to) const;

 private:
  friend MatchTable FindMatches(std::span<const MatchClip> clips, const MatchRules& rules, SearchWork* work,
                                const OnProgress& on_progress);
  std::size_t Pair(int from, int to) const { return static_cast<std::size_t>(from) * asked_.size() + to; }

  std::vector<int> asked_;
  std::vector<std::vector<FrameMatches>> found_;  // by Pair
};

/// Compares every clip's frames with those of every other clip; `rules.pick` plays no part. The last frame of a clip is
/// never a match: nothing would follow it. Exact, as GradeIndex is. `on_progress` is told of the clips that are done.
MatchTable FindMatches(std::span<const MatchClip> clips, const MatchRules& rules = {}, SearchWork* work = nullptr,
                       const OnProgress& on_progress = {});

}  // namespace etude
