#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/transitions/search/grade_blocks.h"

namespace etude {

/// Frames in time order, sixteen to a block, and the box of every block: frames in a row are close to each other, so
/// most blocks are seen to be far as a whole.
struct TimeBlocks {
  TimeBlocks() = default;
  explicit TimeBlocks(std::span<const Grades> frames);

  int frame_count = 0;
  std::vector<FrameBlock> frames;
  std::vector<BoxBlock> boxes;  ///< boxes[i] are those of frames[16 i] …

  int BlockCount() const { return static_cast<int>(frames.size()); }
};

/// A frame of the index, and how far it is from the one that was asked about.
struct Neighbour {
  int frame = 0;
  double distance = 0;  ///< `ComputeDistance`'s value
};

/// The cost of searches as counts, which are the same on every machine.
struct SearchWork {
  std::int64_t distances = 0;  ///< frames whose distance was computed, or found to be too far on the way
  std::int64_t boxes = 0;      ///< likewise, boxes of frames and their least possible distance
};

/// An exact index over the fuzzy grades of frames: every answer is, to the last bit, that of a loop over
/// `ComputeDistance`.
class GradeIndex {
 public:
  /// Indexes `frames` in time order, up to 2³¹ − 1; none of `weights` is negative. Copies what it needs.
  GradeIndex(std::span<const Grades> frames, const FeatureWeights& weights);

  int FrameCount() const { return frame_count_; }
  /// Returns the memory held, bytes.
  std::int64_t Bytes() const;

  /// The first frame in time order with a distance < `threshold`.
  std::optional<Neighbour> First(const Grades& query, double threshold, SearchWork* work = nullptr) const;
  /// Returns all frames with a distance < `threshold`, in time order.
  std::vector<Neighbour> Within(const Grades& query, double threshold, SearchWork* work = nullptr) const;
  /// The `k` frames of smallest distance, by distance, then in time order; all frames when there are fewer than `k`.
  std::vector<Neighbour> Nearest(const Grades& query, int k, SearchWork* work = nullptr) const;

 private:
  /// A level of the tree: one node per sixteen nodes (on the lowest level: frame blocks) of the level below.
  struct Level {
    std::vector<BoxBlock> boxes;    ///< of each node's children
    std::vector<int> first_frames;  ///< of each child
  };
  struct Child {
    double bound;  ///< the least distance that a frame below it can have
    int first_frame;
    int index;
  };
  struct Node;
  struct Children;
  struct NearestSearch;
  struct FirstSearch;
  struct WithinSearch;

  void BuildLevels(std::span<const Grades> frames);
  void AddLevel(std::span<const Node> nodes);
  static void AddChild(std::vector<Node>& nodes, std::size_t number, const Node& child);
  int TopLevel() const { return static_cast<int>(levels_.size()) - 1; }
  Children ChildrenWithin(int level, int node, const GradeBox& query, double distance, SearchWork& work) const;
  BlockResult FramesWithin(int block, const GradeBox& query, double distance, SearchWork& work) const;
  void FindNearest(int level, int node, NearestSearch& search) const;
  std::optional<Neighbour> FirstInHead(const Grades& query, double threshold, SearchWork& work) const;
  void FindFirst(int level, int node, FirstSearch& search) const;
  void FindWithin(int level, int node, WithinSearch& search) const;

  int frame_count_ = 0;
  GradeMetric metric_;
  TimeBlocks head_;         ///< the first frames once more, in time order: most first matches are among them
  std::vector<int> order_;  ///< the frames of all blocks, one block after the other
  std::vector<FrameBlock> blocks_;
  std::vector<Level> levels_;  ///< the lowest first; the last has one node; none when there are no frames
};

}  // namespace etude
