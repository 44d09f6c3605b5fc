#pragma once

#include <span>
#include <vector>

#include "engine/transitions/search/grade_blocks.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A clip, prepared for a comparison of its frames with the frames of other clips.
class MatchClip {
 public:
  /// Prepares a clip. `grades` and `tags` have one entry per frame; tags are read only if `rules.within_class`.
  /// `frames` are the participating frames (for instance the bridge frames) in ascending order.
  MatchClip(std::span<const Grades> grades, std::span<const Tags> tags, std::span<const int> frames,
            const MatchRules& rules);

  /// Returns the participating frames.
  std::span<const int> Frames() const { return frames_; }

 private:
  friend class PairSearch;

  std::vector<int> frames_;
  std::vector<Grades> grades_;  // one per frame of `frames_`, like the next two members
  std::vector<Tags> tags_;      // the ten tags of each frame; empty if the rules do not compare within classes
  std::vector<double> steps_;   // fuzzy distance from the frame before
  std::vector<GradeBox> boxes_;  // one per sixteen of `frames_`
  // The targets: `frames_` without the clip's last frame, in blocks of sixteen in time order. Consecutive frames are
  // near each other, so most blocks can be rejected by the block's box.
  int target_count_ = 0;
  std::vector<FrameBlock> targets_;
  std::vector<BoxBlock> target_boxes_;  // target_boxes_[i]: boxes of targets_[16 i] … targets_[16 i + 15]
};

/// Returns the frames of `from` that match (d < threshold) a frame of `to`, in ascending order. The last frame of `to`
/// never matches, because no frame follows it. `rules` must be the rules with which both clips were prepared;
/// `rules.pick` has no effect. The result is exactly that of a loop over `ComputeDistance`.
std::vector<int> FindMatchingFrames(const MatchClip& from, const MatchClip& to, const MatchRules& rules);

}  // namespace etude
