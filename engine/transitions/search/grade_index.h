#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"
#include "engine/transitions/search/grade_blocks.h"

namespace etude {

/// An index over the fuzzy grades of all frames of a library. It finds whether a frame matches a frame of any other
/// clip. The answer is exactly that of a loop over `ComputeDistance`.
class GradeIndex {
 public:
  /// A frame for which a match is searched.
  struct Query {
    const Grades& grades;
    double threshold = 0;          ///< a frame matches if its distance is smaller
    int own_first = 0;             ///< frames own_first … own_end − 1 belong to the query's own clip and never match
    int own_end = 0;
    const Tags* tags = nullptr;    ///< if not null, only frames with the same ten tags match
  };

  /// Indexes at most 2³¹ − 1 `frames`, with `weights` ≥ 0. Frames of one clip must be consecutive. `tags` has one entry
  /// per frame, or is empty if no query has tags. Frames and tags are copied.
  GradeIndex(std::span<const Grades> frames, const FeatureWeights& weights, std::span<const Tags> tags = {});

  int FrameCount() const { return static_cast<int>(order_.size()); }
  /// Returns the memory in use, in bytes.
  std::int64_t Bytes() const;

  /// Returns true if any frame matches. The search begins in block `hint`; a match sets `hint` to its block. `hint`
  /// affects only speed: set it to 0 before the first search, and do not change it between searches for similar frames.
  bool HasMatch(const Query& query, int& hint) const;

 private:
  /// A level of the tree. One node stands for sixteen nodes of the level below, or on the lowest level for sixteen
  /// frame blocks.
  struct Level {
    std::vector<BoxBlock> boxes;  ///< boxes of each node's children
    std::vector<int> first_frames, last_frames;  ///< for each child: the first and the last frame
  };
  struct Node;

  void AddLevel(std::span<const Node> nodes);
  bool HasMatchBelow(int level, int node, const Query& query, int& hint) const;
  bool HasMatchIn(int block, const Query& query) const;

  GradeMetric metric_;
  std::vector<int> order_;  ///< frame indices, block by block
  std::vector<FrameBlock> blocks_;
  std::vector<Tags> tags_;     ///< the ten tags of each frame, in the order of `order_`; empty if no query has tags
  std::vector<Level> levels_;  ///< the lowest level first; the last has one node; empty if there are no frames
};

}  // namespace etude
