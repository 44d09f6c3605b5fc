#include "engine/transitions/search/frame_matches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/transitions/search/grade_index.h"

namespace etude {
namespace {

/// A clip prepared for the search: its participating frames, both as queries and as targets.
struct ReadyClip {
  std::vector<int> frames;      // the participating frames
  std::vector<Grades> grades;   // per frame of `frames`
  std::vector<Tags> tags;       // per frame of `frames`; empty if classes do not matter
  std::vector<double> steps;    // distance of each of `frames` to the one before
  std::vector<GradeBox> boxes;  // one per sixteen of `frames`
  TimeBlocks targets;           // of `frames`, without the clip's last frame
};

ReadyClip MakeReady(const MatchClip& clip, const MatchRules& rules) {
  // Collect the participating frames with their grades and tags.
  ReadyClip ready;
  if (clip.frames) {
    ready.frames.assign(clip.frames->begin(), clip.frames->end());
  } else {
    ready.frames.resize(clip.grades.size());
    std::iota(ready.frames.begin(), ready.frames.end(), 0);
  }
  for (int frame : ready.frames) {
    ready.grades.push_back(clip.grades[frame]);
    if (rules.within_class) ready.tags.push_back(clip.tags[frame]);
  }
  // Compute steps and boxes for the queries, and blocks for the targets.
  const std::span<const Grades> grades = ready.grades;
  for (std::size_t i = 0; i < grades.size(); ++i) {
    ready.steps.push_back(ComputeDistance(grades[i], grades[i > 0 ? i - 1 : 0], rules.weights).value);
  }
  for (std::size_t i = 0; i < grades.size(); i += kBlockLanes) {
    ready.boxes.push_back(BoxOf(grades.subspan(i, std::min<std::size_t>(kBlockLanes, grades.size() - i))));
  }
  const bool has_last = !grades.empty() && ready.frames.back() + 1 == static_cast<int>(clip.grades.size());
  ready.targets = TimeBlocks(grades.first(grades.size() - (has_last ? 1 : 0)));
  return ready;
}

/// Finds the frames of another clip that match the frames of one clip.
///
/// The query frames are processed in time order, and motion is smooth. By the triangle inequality, the distance to a
/// block of targets can shrink from one query to a later one by at most the summed distance between the queries. So a
/// block is compared again only when that sum has become large enough.
class PairSearch {
 public:
  PairSearch(const GradeMetric& metric, const MatchRules& rules, const ReadyClip& from, const ReadyClip& to)
      : metric_(metric), rules_(rules), from_(from), to_(to) {}

  std::vector<FrameMatches> Run(SearchWork& work) {
    std::vector<FrameMatches> found;
    for (std::size_t block = 0; block < from_.boxes.size(); ++block) {
      FindNearBlocks(from_.boxes[block], work);
      if (near_.empty()) continue;
      const std::size_t start = block * kBlockLanes;
      const std::size_t end = std::min(start + kBlockLanes, from_.frames.size());
      travelled_ = 0;
      for (std::size_t i = start; i < end; ++i) {
        if (i > start) travelled_ += from_.steps[i];
        if (const auto matches = FindFor(i, work)) found.push_back(*matches);
      }
    }
    return found;
  }

 private:
  /// A target, as an index into to_.frames.
  struct Best {
    int index;
    double distance;
  };
  struct NearBlock {
    int block;
    double bound;  // lower bound for the distance from all sixteen query frames
    double reach;  // distance at the last comparison plus `travelled_` at that time
  };

  /// Collects the target blocks, in time order, that may hold a match of a frame in `asking`.
  void FindNearBlocks(const GradeBox& asking, SearchWork& work) {
    near_.clear();
    const double limit = SquaredLimit(rules_.threshold);
    for (int node = 0; node * kBlockLanes < to_.targets.BlockCount(); ++node) {
      const int count = std::min(kBlockLanes, to_.targets.BlockCount() - node * kBlockLanes);
      work.boxes += count;
      const BlockResult bounds = SquaredBounds(metric_, asking, to_.targets.boxes[node], limit);
      ForEachLane(bounds.kept & LanesOf(count), [&](int lane) {
        near_.push_back({node * kBlockLanes + lane, std::sqrt(bounds.squared[lane]), 0});
      });
    }
  }

  /// Returns a lower bound of the distance from the current query frame to any frame of the block.
  double LeastDistance(const NearBlock& near) const {
    // The margin is larger than the rounding errors of distances and their sums, and too small to cause needless
    // comparisons.
    constexpr double kRounding = 1e-9, kTiniest = 1e-150;
    const double rest = near.reach - travelled_ - kRounding * (near.reach + travelled_) - kTiniest;
    return std::max(near.bound, rest);
  }

  std::optional<FrameMatches> FindFor(std::size_t asking, SearchWork& work) {
    // Visit the blocks in time order until the first match is found.
    std::optional<int> first;
    Best nearest{0, rules_.threshold};
    std::size_t next = 0;
    for (; next < near_.size() && !first; ++next) {
      if (LeastDistance(near_[next]) < rules_.threshold) first = CompareBlock(asking, near_[next], nearest, work);
    }
    if (!first) return std::nullopt;
    // Then try the block that held the previous frame's nearest match, because a small distance excludes most other
    // blocks.
    const auto hint = std::ranges::lower_bound(near_, hint_, {}, &NearBlock::block);
    if (hint != near_.end() && hint - near_.begin() >= static_cast<std::ptrdiff_t>(next)) {
      CompareBlock(asking, *hint, nearest, work);
    }
    // Visit the remaining blocks that may hold a nearer match.
    for (; next < near_.size(); ++next) {
      if (LeastDistance(near_[next]) <= nearest.distance) CompareBlock(asking, near_[next], nearest, work);
    }
    hint_ = nearest.index / kBlockLanes;
    return FrameMatches{from_.frames[asking], to_.frames[*first], to_.frames[nearest.index], nearest.distance};
  }

  /// Compares the query with one block. Improves `nearest`, and returns the first frame that improved it.
  ///
  /// Before the first match, `nearest` is at the threshold, so the first frame that improves it is the first match.
  std::optional<int> CompareBlock(std::size_t asking, NearBlock& near, Best& nearest, SearchWork& work) const {
    // Distances up to twice the threshold are computed, because they show for how many queries the block can be
    // skipped.
    const double farthest = 2 * rules_.threshold;
    const int start = near.block * kBlockLanes;
    const int count = std::min(kBlockLanes, to_.targets.frame_count - start);
    work.distances += count;
    const BlockResult result =
        SquaredDistances(metric_, from_.grades[asking], to_.targets.frames[near.block], SquaredLimit(farthest));
    const double least = std::sqrt(result.least);
    near.reach = least + travelled_;
    std::optional<int> first;
    if (least > nearest.distance) return first;
    const double limit = SquaredLimit(nearest.distance);
    ForEachLane(result.kept & LanesOf(count), [&](int lane) {
      if (result.squared[lane] > limit) return;
      const double distance = std::sqrt(result.squared[lane]);
      const int index = start + lane;
      // Blocks are not visited in the order of frames, so ties are resolved in favour of the earlier frame.
      const bool is_nearer = distance < nearest.distance ||
                             (distance == nearest.distance && distance < rules_.threshold && index < nearest.index);
      if (!is_nearer || (rules_.within_class && from_.tags[asking] != to_.tags[index])) return;
      if (!first) first = index;
      nearest = {index, distance};
    });
    return first;
  }

  const GradeMetric& metric_;
  const MatchRules& rules_;
  const ReadyClip& from_;
  const ReadyClip& to_;
  std::vector<NearBlock> near_;
  double travelled_ = 0;  // sum of the distances between queries since the first of the sixteen
  int hint_ = 0;          // the block of the last nearest match
};

}  // namespace

double MatchTable::Share(int from, int to) const {
  const int asked = QueryFrames(from);
  return asked == 0 ? 0 : static_cast<double>(Of(from, to).size()) / asked;
}

MatchTable FindMatches(std::span<const MatchClip> clips, const MatchRules& rules, SearchWork* work,
                       const OnProgress& on_progress) {
  MatchTable table;
  // Prepare every clip once, then search every pair of clips.
  std::vector<ReadyClip> ready;
  for (const MatchClip& clip : clips) {
    ready.push_back(MakeReady(clip, rules));
    table.asked_.push_back(static_cast<int>(ready.back().frames.size()));
  }
  table.found_.resize(clips.size() * clips.size());
  if (!(rules.threshold > 0)) return table;
  const GradeMetric metric(rules.weights);
  SearchWork done;
  for (std::size_t a = 0; a < clips.size(); ++a) {
    for (std::size_t b = 0; b < clips.size(); ++b) {
      if (a == b) continue;
      table.found_[a * clips.size() + b] = PairSearch(metric, rules, ready[a], ready[b]).Run(done);
    }
    if (on_progress) on_progress(a + 1, clips.size());
  }
  if (work) {
    work->distances += done.distances;
    work->boxes += done.boxes;
  }
  return table;
}

}  // namespace etude
