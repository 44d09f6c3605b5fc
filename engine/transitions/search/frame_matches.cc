#include "engine/transitions/search/frame_matches.h"

#include <algorithm>
#include <cmath>

namespace etude {

MatchClip::MatchClip(std::span<const Grades> grades, std::span<const Tags> tags, std::span<const int> frames,
                     const MatchRules& rules)
    : frames_(frames.begin(), frames.end()) {
  for (int frame : frames_) {
    grades_.push_back(grades[frame]);
    if (rules.within_class) tags_.push_back(tags[frame]);
  }
  // Prepare the frames as queries: their distances from the frame before, and a bounding box per sixteen frames.
  const std::span<const Grades> own = grades_;
  const auto block_at = [&](std::size_t i) {
    return own.subspan(i, std::min<std::size_t>(kBlockLanes, own.size() - i));
  };
  for (std::size_t i = 0; i < own.size(); ++i) {
    steps_.push_back(ComputeDistance(own[i], own[i > 0 ? i - 1 : 0], rules.weights).value);
  }
  for (std::size_t i = 0; i < own.size(); i += kBlockLanes) boxes_.push_back(BoxOf(block_at(i)));
  // Prepare the frames as targets: blocks of sixteen with their bounding boxes.
  const bool has_last = !own.empty() && frames_.back() + 1 == static_cast<int>(grades.size());
  target_count_ = static_cast<int>(own.size()) - (has_last ? 1 : 0);
  targets_.resize(static_cast<std::size_t>(BlocksFor(static_cast<std::size_t>(target_count_))));
  target_boxes_.resize(static_cast<std::size_t>(BlocksFor(targets_.size())));
  for (int i = 0; i < target_count_; ++i) targets_[i / kBlockLanes].Set(i % kBlockLanes, own[i]);
  for (std::size_t b = 0; b < targets_.size(); ++b) {
    const std::size_t start = b * kBlockLanes;
    const std::size_t count = std::min<std::size_t>(kBlockLanes, static_cast<std::size_t>(target_count_) - start);
    target_boxes_[b / kBlockLanes].Set(static_cast<int>(b % kBlockLanes), BoxOf(own.subspan(start, count)));
  }
}

/// Finds the frames of one clip that match frames of another clip.
///
/// The query frames are processed in time order, and motion is smooth. By the triangle inequality, the distance to a
/// block of targets can shrink from one query to a later query by at most the summed distance between the queries. A
/// block is therefore compared again only when that sum has become large enough.
class PairSearch {
 public:
  PairSearch(const MatchClip& from, const MatchClip& to, const MatchRules& rules)
      : metric_(rules.weights), rules_(rules), from_(from), to_(to) {}

  std::vector<int> Run() {
    std::vector<int> found;
    for (std::size_t block = 0; block < from_.boxes_.size(); ++block) {
      FindNearBlocks(from_.boxes_[block]);
      if (near_.empty()) continue;
      const std::size_t start = block * kBlockLanes;
      const std::size_t end = std::min(start + kBlockLanes, from_.frames_.size());
      travelled_ = 0;
      for (std::size_t i = start; i < end; ++i) {
        if (i > start) travelled_ += from_.steps_[i];
        if (HasMatch(i)) found.push_back(from_.frames_[i]);
      }
    }
    return found;
  }

 private:
  struct NearBlock {
    int block;
    double bound;  // lower bound for the distance from any of the sixteen query frames
    double reach;  // distance at the last comparison plus the value that `travelled_` had at that time
  };

  /// Collects the target blocks that may contain a match of a query frame in the box `asking`.
  void FindNearBlocks(const GradeBox& asking) {
    near_.clear();
    const double limit = SquaredLimit(rules_.threshold);
    const int block_count = static_cast<int>(to_.targets_.size());
    for (int node = 0; node * kBlockLanes < block_count; ++node) {
      const int count = std::min(kBlockLanes, block_count - node * kBlockLanes);
      const BlockResult bounds = SquaredBounds(metric_, asking, to_.target_boxes_[node], limit);
      ForEachLane(bounds.kept & LanesOf(count), [&](int lane) {
        near_.push_back({node * kBlockLanes + lane, std::sqrt(bounds.squared[lane]), 0});
      });
    }
  }

  /// Returns a lower bound of the distance from the current query frame to any frame of the block.
  double LeastDistance(const NearBlock& near) const {
    // The margin is larger than the rounding errors of distances and their sums, but too small to cause many needless
    // comparisons.
    constexpr double kRounding = 1e-9, kTiniest = 1e-150;
    const double rest = near.reach - travelled_ - kRounding * (near.reach + travelled_) - kTiniest;
    return std::max(near.bound, rest);
  }

  bool HasMatch(std::size_t asking) {
    for (std::size_t i = 0; i < near_.size(); ++i) {
      if (LeastDistance(near_[i]) >= rules_.threshold || !CompareBlock(asking, near_[i])) continue;
      // Move this block to the front: the next frame is similar, so it probably matches a frame of the same block.
      std::swap(near_[0], near_[i]);
      return true;
    }
    return false;
  }

  /// Returns true if the query frame `asking` matches a frame of the block.
  bool CompareBlock(std::size_t asking, NearBlock& near) const {
    // Compute distances up to twice the threshold; they determine for how many queries the block can be skipped.
    const double farthest = 2 * rules_.threshold;
    const int start = near.block * kBlockLanes;
    const BlockResult result =
        SquaredDistances(metric_, from_.grades_[asking], to_.targets_[near.block], SquaredLimit(farthest));
    near.reach = std::sqrt(result.least) + travelled_;
    bool has_match = false;
    ForEachLane(result.kept & LanesOf(std::min(kBlockLanes, to_.target_count_ - start)), [&](int lane) {
      if (rules_.within_class && from_.tags_[asking] != to_.tags_[start + lane]) return;
      has_match = has_match || std::sqrt(result.squared[lane]) < rules_.threshold;
    });
    return has_match;
  }

  const GradeMetric metric_;
  const MatchRules& rules_;
  const MatchClip& from_;
  const MatchClip& to_;
  std::vector<NearBlock> near_;
  double travelled_ = 0;  // sum of the distances between consecutive queries since the start of the block of queries
};

std::vector<int> FindMatchingFrames(const MatchClip& from, const MatchClip& to, const MatchRules& rules) {
  if (!(rules.threshold > 0)) return {};
  return PairSearch(from, to, rules).Run();
}

}  // namespace etude
