#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/transitions/search/grade_blocks.h"

namespace etude {

/// Frames in time order in blocks of sixteen, with a box per block. Consecutive frames are near each other, so most
/// blocks can be rejected by their box.
struct TimeBlocks {
  TimeBlocks() = default;
  explicit TimeBlocks(std::span<const Grades> frames);

  int frame_count = 0;
  std::vector<FrameBlock> frames;
  std::vector<BoxBlock> boxes;  ///< boxes[i] holds the boxes of frames[16 i] …

  int BlockCount() const { return static_cast<int>(frames.size()); }
};

/// A frame of the index and its distance from the query.
struct Neighbour {
  int frame = 0;
  double distance = 0;  ///< identical to `ComputeDistance`
};

/// The cost of searches, as counts that are the same on every machine.
struct SearchWork {
  std::int64_t distances = 0;  ///< frames whose distance was computed, completely or until it was too large
  std::int64_t boxes = 0;      ///< boxes whose lower bound was computed, completely or until it was too large
};

/// An exact index over the fuzzy grades of frames: every result is bit-identical to that of a loop over
/// `ComputeDistance`.
class GradeIndex {
 public:
  /// Indexes at most 2³¹ − 1 `frames`, given in time order, with `weights` ≥ 0. It copies the frames.
  GradeIndex(std::span<const Grades> frames, const FeatureWeights& weights);

  int FrameCount() const { return frame_count_; }
  /// Returns the memory in use, in bytes.
  std::int64_t Bytes() const;

  /// Returns the first frame in time order with a distance < `threshold`; nothing if there is none.
  std::optional<Neighbour> First(const Grades& query, double threshold, SearchWork* work = nullptr) const;
  /// Returns all frames with a distance < `threshold`, in time order.
  std::vector<Neighbour> Within(const Grades& query, double threshold, SearchWork* work = nullptr) const;
  /// Returns the `k` frames of smallest distance, sorted by distance, then by time; or all frames if there are fewer
  /// than `k`.
  std::vector<Neighbour> Nearest(const Grades& query, int k, SearchWork* work = nullptr) const;

 private:
  /// A level of the tree, with one node per sixteen nodes of the level below (on the lowest level: per sixteen frame
  /// blocks).
  struct Level {
    std::vector<BoxBlock> boxes;    ///< boxes of each node's children
    std::vector<int> first_frames;  ///< first frame of each child
  };
  struct Child {
    double bound;  ///< lower bound of the distance of the frames below it
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
  TimeBlocks head_;         ///< a copy of the first frames in time order, which hold most first matches
  std::vector<int> order_;  ///< frame indices, block by block
  std::vector<FrameBlock> blocks_;
  std::vector<Level> levels_;  ///< the lowest level first; the last has one node; empty without frames
};

}  // namespace etude
