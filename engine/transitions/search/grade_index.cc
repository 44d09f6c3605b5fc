#include "engine/transitions/search/grade_index.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

namespace etude {
namespace {

/// A frame's index, and the frame's coordinate along the axis of a split.
struct Placed {
  double at;
  int frame;
};

class Splitter {
 public:
  Splitter(std::span<const Grades> frames, const GradeMetric& metric) : frames_(frames), placed_(frames.size()) {
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      for (std::size_t t = metric.first_term[k]; t < metric.first_term[k + 1]; ++t) weights_[t] = metric.weights[k];
    }
  }

  void Split(std::span<int> order) {
    if (order.size() <= kBlockLanes) {
      std::ranges::sort(order);
      return;
    }
    const std::size_t axis = WidestAxis(order);
    const std::span<Placed> placed(placed_.data(), order.size());
    for (std::size_t i = 0; i < order.size(); ++i) placed[i] = {frames_[order[i]][axis], order[i]};
    // The number of blocks on the left is a power of two, so each block and each group of sixteen blocks is a subtree.
    const std::size_t blocks = (order.size() + kBlockLanes - 1) / kBlockLanes;
    const std::size_t left = std::bit_ceil(blocks) / 2 * kBlockLanes;
    std::ranges::nth_element(placed, placed.begin() + static_cast<std::ptrdiff_t>(left), {},
                             [](const Placed& p) { return std::tuple(p.at, p.frame); });
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = placed[i].frame;
    Split(order.first(left));
    Split(order.subspan(left));
  }

 private:
  /// Returns the term whose weighted grades vary most, estimated from a sample of the frames.
  std::size_t WidestAxis(std::span<const int> order) const {
    constexpr std::size_t kSample = 64;
    const std::size_t step = std::max<std::size_t>(1, order.size() / kSample);
    Grades sum{}, squares{};
    double count = 0;
    for (std::size_t i = 0; i < order.size(); i += step, ++count) {
      const Grades& grades = frames_[order[i]];
      for (std::size_t t = 0; t < kTermCount; ++t) {
        sum[t] += grades[t];
        squares[t] += grades[t] * grades[t];
      }
    }
    std::size_t widest = 0;
    double largest = -1;
    for (std::size_t t = 0; t < kTermCount; ++t) {
      const double variance = weights_[t] * (squares[t] - sum[t] * sum[t] / count);
      if (variance > largest) {
        largest = variance;
        widest = t;
      }
    }
    return widest;
  }

  std::span<const Grades> frames_;
  Grades weights_{};
  std::vector<Placed> placed_;
};

/// Returns the indices of all frames in the order of a k-d tree: every `kBlockLanes` consecutive indices form a block
/// of similar frames, every sixteen consecutive blocks form a node of the lowest level, and so on upwards. Within a
/// block the frames are in time order.
std::vector<int> OrderForBlocks(std::span<const Grades> frames, const GradeMetric& metric) {
  std::vector<int> order(frames.size());
  std::iota(order.begin(), order.end(), 0);
  Splitter(frames, metric).Split(order);
  return order;
}

}  // namespace

/// The bounding box of the frames below a node, and the first and the last of these frames.
struct GradeIndex::Node {
  GradeBox box;
  int first_frame, last_frame;
};

GradeIndex::GradeIndex(std::span<const Grades> frames, const FeatureWeights& weights, std::span<const Tags> tags)
    : metric_(weights),
      order_(OrderForBlocks(frames, metric_)),
      blocks_(static_cast<std::size_t>(BlocksFor(frames.size()))) {
  if (frames.empty()) return;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    blocks_[i / kBlockLanes].Set(static_cast<int>(i % kBlockLanes), frames[order_[i]]);
    if (!tags.empty()) tags_.push_back(tags[order_[i]]);
  }
  // Build the tree upwards. `below` holds the nodes of the level below; at first these are the frame blocks.
  std::vector<Node> below;
  const auto add_to_last = [](std::vector<Node>& nodes, std::size_t number, const Node& child) {
    if (number % kBlockLanes == 0) {
      nodes.push_back(child);
      return;
    }
    nodes.back().box.Include(child.box);
    nodes.back().first_frame = std::min(nodes.back().first_frame, child.first_frame);
    nodes.back().last_frame = std::max(nodes.back().last_frame, child.last_frame);
  };
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Grades& grades = frames[order_[i]];
    add_to_last(below, i, {{grades, grades}, order_[i], order_[i]});
  }
  AddLevel(below);
  while (below.size() > kBlockLanes) {
    std::vector<Node> above;
    for (std::size_t i = 0; i < below.size(); ++i) add_to_last(above, i, below[i]);
    below = std::move(above);
    AddLevel(below);
  }
}

void GradeIndex::AddLevel(std::span<const Node> nodes) {
  Level& level = levels_.emplace_back();
  level.boxes.resize(static_cast<std::size_t>(BlocksFor(nodes.size())));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    level.boxes[i / kBlockLanes].Set(static_cast<int>(i % kBlockLanes), nodes[i].box);
    level.first_frames.push_back(nodes[i].first_frame);
    level.last_frames.push_back(nodes[i].last_frame);
  }
}

std::int64_t GradeIndex::Bytes() const {
  std::size_t bytes = order_.size() * sizeof(int) + blocks_.size() * sizeof(FrameBlock) + tags_.size() * sizeof(Tags);
  for (const Level& level : levels_) {
    bytes += level.boxes.size() * sizeof(BoxBlock) + 2 * level.first_frames.size() * sizeof(int);
  }
  return static_cast<std::int64_t>(bytes);
}

bool GradeIndex::HasMatch(const Query& query, int& hint) const {
  if (blocks_.empty() || !(query.threshold > 0)) return false;
  // Try the block of the last match first: consecutive frames are similar.
  if (hint >= 0 && hint < static_cast<int>(blocks_.size()) && HasMatchIn(hint, query)) return true;
  return HasMatchBelow(static_cast<int>(levels_.size()) - 1, 0, query, hint);
}

bool GradeIndex::HasMatchIn(int block, const Query& query) const {
  const int start = block * kBlockLanes;
  const int count = std::min(kBlockLanes, FrameCount() - start);
  const BlockResult near =
      SquaredDistances(metric_, query.grades, blocks_[block], SquaredLimit(query.threshold));
  for (std::uint32_t kept = near.kept & LanesOf(count); kept != 0; kept &= kept - 1) {
    const int lane = std::countr_zero(kept);
    const int frame = order_[start + lane];
    if (frame >= query.own_first && frame < query.own_end) continue;
    if (query.tags != nullptr && tags_[start + lane] != *query.tags) continue;
    if (std::sqrt(near.squared[lane]) < query.threshold) return true;
  }
  return false;
}

bool GradeIndex::HasMatchBelow(int level, int node, const Query& query, int& hint) const {
  if (level < 0) {
    if (!HasMatchIn(node, query)) return false;
    hint = node;
    return true;
  }
  // Collect the children that may contain a match. Skip children that contain only frames of the query's own clip.
  const Level& of = levels_[level];
  const int first = node * kBlockLanes;
  const int count = std::min(kBlockLanes, static_cast<int>(of.first_frames.size()) - first);
  const BlockResult bounds =
      SquaredBounds(metric_, {query.grades, query.grades}, of.boxes[node], SquaredLimit(query.threshold));
  std::array<std::pair<double, int>, kBlockLanes> children;  // squared bound, index
  int children_count = 0;
  ForEachLane(bounds.kept & LanesOf(count), [&](int lane) {
    const int child = first + lane;
    if (of.first_frames[child] >= query.own_first && of.last_frames[child] < query.own_end) return;
    children[children_count++] = {bounds.squared[lane], child};
  });
  // Search the nearest child first, because it most likely contains a match.
  std::sort(children.begin(), children.begin() + children_count);
  return std::any_of(children.begin(), children.begin() + children_count,
                     [&](const auto& child) { return HasMatchBelow(level - 1, child.second, query, hint); });
}

}  // namespace etude
