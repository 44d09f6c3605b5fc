#include "engine/transitions/search/frame_matches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/transitions/search/grade_index.h"

namespace etude {
namespace {

/// A clip made ready: those of its frames that take part, as what asks and as what is searched.
struct ReadyClip {
  std::vector<int> frames;      // that take part
  std::vector<Grades> grades;   // of `frames`
  std::vector<Tags> tags;       // of `frames`; empty when classes do not matter
  std::vector<double> steps;    // the distance of each of `frames` from the one before
  std::vector<GradeBox> boxes;  // of every sixteen of `frames`
  TimeBlocks targets;           // of `frames`, without the clip's last frame
};

ReadyClip MakeReady(const MatchClip& clip, const MatchRules& rules) {
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

/// Finds the frames of another clip that match those of one clip.
///
/// Frames ask in time order, and motion is smooth: by the triangle inequality a block of targets that was so and so far
/// from one frame can be nearer to a later one only by the way between the two. So a block is looked at again only
/// when that way has grown long enough to matter.
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
      way_ = 0;
      for (std::size_t i = start; i < end; ++i) {
        if (i > start) way_ += from_.steps[i];
        if (const auto matches = FindFor(i, work)) found.push_back(*matches);
      }
    }
    return found;
  }

 private:
  /// A target, as its place in to_.frames.
  struct Best {
    int place;
    double distance;
  };
  struct NearBlock {
    int block;
    double bound;  // the least distance of any of the sixteen frames that ask
    double reach;  // how far it was at the last look, plus the way until then
  };

  /// The target blocks, in time order, that any frame of `asking` may match a frame of.
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

  /// A lower bound of the distance from the frame that asks to any frame of the block.
  double LeastDistance(const NearBlock& near) const {
    // Larger than the rounding errors of distances and their sums, too small to cause needless block evaluations.
    constexpr double kRounding = 1e-9, kTiniest = 1e-150;
    const double rest = near.reach - way_ - kRounding * (near.reach + way_) - kTiniest;
    return std::max(near.bound, rest);
  }

  std::optional<FrameMatches> FindFor(std::size_t asking, SearchWork& work) {
    std::optional<int> first;
    Best nearest{0, rules_.threshold};
    std::size_t next = 0;
    for (; next < near_.size() && !first; ++next) {
      if (LeastDistance(near_[next]) < rules_.threshold) first = Look(asking, near_[next], nearest, work);
    }
    if (!first) return std::nullopt;
    // Try the block that held the previous frame's nearest match first: a small distance early excludes most others.
    const auto hint = std::ranges::lower_bound(near_, hint_, {}, &NearBlock::block);
    if (hint != near_.end() && hint - near_.begin() >= static_cast<std::ptrdiff_t>(next)) {
      Look(asking, *hint, nearest, work);
    }
    for (; next < near_.size(); ++next) {
      if (LeastDistance(near_[next]) <= nearest.distance) Look(asking, near_[next], nearest, work);
    }
    hint_ = nearest.place / kBlockLanes;
    return FrameMatches{from_.frames[asking], to_.frames[*first], to_.frames[nearest.place], nearest.distance};
  }

  /// Looks at one block: improves `nearest`, and says which is the first frame that did.
  ///
  /// While nothing is found, `nearest` is at the threshold, and the first frame that improves it is the first match.
  std::optional<int> Look(std::size_t asking, NearBlock& near, Best& nearest, SearchWork& work) const {
    // Distances up to twice the threshold are computed: they bound for how many frames the block can be skipped.
    const double farthest = 2 * rules_.threshold;
    const int start = near.block * kBlockLanes;
    const int count = std::min(kBlockLanes, to_.targets.frame_count - start);
    work.distances += count;
    const BlockResult result =
        SquaredDistances(metric_, from_.grades[asking], to_.targets.frames[near.block], SquaredLimit(farthest));
    const double least = std::sqrt(result.least);
    near.reach = least + way_;
    std::optional<int> first;
    if (least > nearest.distance) return first;
    const double limit = SquaredLimit(nearest.distance);
    ForEachLane(result.kept & LanesOf(count), [&](int lane) {
      if (result.squared[lane] > limit) return;
      const double distance = std::sqrt(result.squared[lane]);
      const int place = start + lane;
      // Blocks are not visited in frame order; ties go to the earlier frame.
      const bool is_nearer = distance < nearest.distance ||
                             (distance == nearest.distance && distance < rules_.threshold && place < nearest.place);
      if (!is_nearer || (rules_.within_class && from_.tags[asking] != to_.tags[place])) return;
      if (!first) first = place;
      nearest = {place, distance};
    });
    return first;
  }

  const GradeMetric& metric_;
  const MatchRules& rules_;
  const ReadyClip& from_;
  const ReadyClip& to_;
  std::vector<NearBlock> near_;
  double way_ = 0;  // from the first of the sixteen frames to the one that asks
  int hint_ = 0;    // the block of the nearest match that was found last
};

}  // namespace

double MatchTable::Share(int from, int to) const {
  const int asked = AskedFrames(from);
  return asked == 0 ? 0 : static_cast<double>(Of(from, to).size()) / asked;
}

MatchTable FindMatches(std::span<const MatchClip> clips, const MatchRules& rules, SearchWork* work,
                       const OnProgress& on_progress) {
  MatchTable table;
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
