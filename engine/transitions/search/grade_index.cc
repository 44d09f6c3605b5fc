#include "engine/transitions/search/grade_index.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "engine/transitions/search/grade_blocks.h"

namespace etude {
namespace {

/// A frame and its coordinate along the axis of a split.
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
    // The left side gets a power of two of blocks, so that each block, and each group of sixteen blocks, is a subtree.
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

/// Returns the indices of all frames in the order of a k-d tree: each `kBlockLanes` consecutive frames form a block of
/// near frames, each sixteen blocks form a node, and so on. Within a block the frames are in time order.
std::vector<int> OrderForBlocks(std::span<const Grades> frames, const GradeMetric& metric) {
  std::vector<int> order(frames.size());
  std::iota(order.begin(), order.end(), 0);
  Splitter(frames, metric).Split(order);
  return order;
}

/// Most first matches of a large library are among this many frames; scanning their boxes takes a microsecond.
constexpr std::size_t kHeadFrames = 4096;
constexpr int kNoFrame = std::numeric_limits<int>::max();
constexpr double kFar = std::numeric_limits<double>::infinity();

bool Precedes(const Neighbour& a, const Neighbour& b) {
  return std::tuple(a.distance, a.frame) < std::tuple(b.distance, b.frame);
}

void AddWork(const SearchWork& of_search, SearchWork* work) {
  if (work == nullptr) return;
  work->boxes += of_search.boxes;
  work->distances += of_search.distances;
}

/// Sorts matches by frame. Large results are sorted by radix sort: a frame of a person who stands still can have
/// 100,000 matches.
void SortByFrame(std::vector<Neighbour>& found, int frame_count) {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  if (found.size() < kDigits) {
    std::ranges::sort(found, {}, &Neighbour::frame);
    return;
  }
  std::vector<Neighbour> sorted(found.size());
  for (int shift = 0; (std::int64_t{frame_count} >> shift) > 0; shift += kDigitBits) {
    const auto digit_of = [&](const Neighbour& n) { return static_cast<std::size_t>(n.frame >> shift) % kDigits; };
    std::array<std::size_t, kDigits + 1> offsets{};
    for (const Neighbour& neighbour : found) ++offsets[digit_of(neighbour) + 1];
    for (std::size_t d = 0; d < kDigits; ++d) offsets[d + 1] += offsets[d];
    for (const Neighbour& neighbour : found) sorted[offsets[digit_of(neighbour)]++] = neighbour;
    found.swap(sorted);
  }
}

}  // namespace

/// The bounding box of the frames below a node, and the first of these frames.
struct GradeIndex::Node {
  GradeBox box;
  int first_frame;
};

struct GradeIndex::Children {
  std::array<Child, kBlockLanes> array;
  int count = 0;

  Child* begin() { return array.data(); }
  Child* end() { return array.data() + std::min(count, kBlockLanes); }  // GCC 16 sees no other bound and warns
};

struct GradeIndex::NearestSearch {
  GradeBox query;
  std::size_t k;
  std::vector<Neighbour> best;  // a heap with the worst one in front
  SearchWork work{};

  Neighbour Worst() const { return best.size() < k ? Neighbour{kNoFrame, kFar} : best.front(); }
  void Offer(const Neighbour& neighbour) {
    if (!Precedes(neighbour, Worst())) return;
    if (best.size() == k) {
      std::ranges::pop_heap(best, Precedes);
      best.pop_back();
    }
    best.push_back(neighbour);
    std::ranges::push_heap(best, Precedes);
  }
};

struct GradeIndex::FirstSearch {
  GradeBox query;
  double threshold;
  Neighbour best{kNoFrame, kFar};
  SearchWork work{};
};

struct GradeIndex::WithinSearch {
  GradeBox query;
  double threshold;
  std::vector<Neighbour> found;
  SearchWork work{};
};

GradeIndex::GradeIndex(std::span<const Grades> frames, const FeatureWeights& weights)
    : frame_count_(static_cast<int>(frames.size())),
      metric_(weights),
      head_(frames.first(std::min(frames.size(), kHeadFrames))),
      order_(OrderForBlocks(frames, metric_)),
      blocks_(static_cast<std::size_t>(BlocksFor(frames.size()))) {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    blocks_[i / kBlockLanes].Set(static_cast<int>(i % kBlockLanes), frames[order_[i]]);
  }
  if (!frames.empty()) BuildLevels(frames);
}

void GradeIndex::BuildLevels(std::span<const Grades> frames) {
  // The nodes one level below the current one; the first are the frame blocks.
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Grades& grades = frames[order_[i]];
    AddChild(nodes, i, {{grades, grades}, order_[i]});
  }
  AddLevel(nodes);
  while (nodes.size() > kBlockLanes) {
    std::vector<Node> above;
    for (std::size_t i = 0; i < nodes.size(); ++i) AddChild(above, i, nodes[i]);
    nodes = std::move(above);
    AddLevel(nodes);
  }
}

void GradeIndex::AddLevel(std::span<const Node> nodes) {
  Level& level = levels_.emplace_back();
  level.boxes.resize(static_cast<std::size_t>(BlocksFor(nodes.size())));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    level.boxes[i / kBlockLanes].Set(static_cast<int>(i % kBlockLanes), nodes[i].box);
    level.first_frames.push_back(nodes[i].first_frame);
  }
}

/// Adds child `number` to the last node, or to a new node if the last one is full.
void GradeIndex::AddChild(std::vector<Node>& nodes, std::size_t number, const Node& child) {
  if (number % kBlockLanes == 0) {
    nodes.push_back(child);
    return;
  }
  Node& node = nodes.back();
  node.box.Include(child.box);
  node.first_frame = std::min(node.first_frame, child.first_frame);
}

std::int64_t GradeIndex::Bytes() const {
  std::size_t bytes = order_.size() * sizeof(int) + (blocks_.size() + head_.frames.size()) * sizeof(FrameBlock) +
                      head_.boxes.size() * sizeof(BoxBlock);
  for (const Level& level : levels_) {
    bytes += level.boxes.size() * sizeof(BoxBlock) + level.first_frames.size() * sizeof(int);
  }
  return static_cast<std::int64_t>(bytes);
}

GradeIndex::Children GradeIndex::ChildrenWithin(int level, int node, const GradeBox& query, double distance,
                                                SearchWork& work) const {
  const Level& of = levels_[level];
  const int first = node * kBlockLanes;
  const int count = std::min(kBlockLanes, static_cast<int>(of.first_frames.size()) - first);
  work.boxes += count;
  BlockResult result = SquaredBounds(metric_, query, of.boxes[node], SquaredLimit(distance));
  result.kept &= LanesOf(count);
  Children children;
  ForEachLane(result.kept, [&](int lane) {
    children.array[children.count++] = {std::sqrt(result.squared[lane]), of.first_frames[first + lane], first + lane};
  });
  return children;
}

BlockResult GradeIndex::FramesWithin(int block, const GradeBox& query, double distance, SearchWork& work) const {
  const int count = std::min(kBlockLanes, frame_count_ - block * kBlockLanes);
  work.distances += count;
  BlockResult result = SquaredDistances(metric_, query.low, blocks_[block], SquaredLimit(distance));
  result.kept &= LanesOf(count);
  return result;
}

std::vector<Neighbour> GradeIndex::Nearest(const Grades& query, int k, SearchWork* work) const {
  if (k <= 0 || frame_count_ == 0) return {};
  NearestSearch search{.query = {query, query}, .k = static_cast<std::size_t>(std::min(k, frame_count_)), .best = {}};
  search.best.reserve(search.k + 1);
  FindNearest(TopLevel(), 0, search);
  AddWork(search.work, work);
  std::ranges::sort_heap(search.best, Precedes);
  return search.best;
}

void GradeIndex::FindNearest(int level, int node, NearestSearch& search) const {
  if (level < 0) {
    const BlockResult near = FramesWithin(node, search.query, search.Worst().distance, search.work);
    ForEachLane(near.kept, [&](int lane) {
      search.Offer({order_[node * kBlockLanes + lane], std::sqrt(near.squared[lane])});
    });
    return;
  }
  // Visit the nearest children first, until the rest cannot improve the result.
  Children children = ChildrenWithin(level, node, search.query, search.Worst().distance, search.work);
  std::ranges::sort(children, {}, [](const Child& c) { return std::tuple(c.bound, c.first_frame); });
  for (const Child& child : children) {
    if (!Precedes({child.first_frame, child.bound}, search.Worst())) break;
    FindNearest(level - 1, child.index, search);
  }
}

std::optional<Neighbour> GradeIndex::First(const Grades& query, double threshold, SearchWork* work) const {
  if (frame_count_ == 0 || !(threshold > 0)) return std::nullopt;
  FirstSearch search{.query = {query, query}, .threshold = threshold};
  if (const auto early = FirstInHead(query, threshold, search.work)) {
    search.best = *early;
  } else if (head_.frame_count < frame_count_) {
    FindFirst(TopLevel(), 0, search);
  }
  AddWork(search.work, work);
  if (search.best.frame == kNoFrame) return std::nullopt;
  return search.best;
}

std::optional<Neighbour> GradeIndex::FirstInHead(const Grades& query, double threshold, SearchWork& work) const {
  const double limit = SquaredLimit(threshold);
  for (int node = 0; node * kBlockLanes < head_.BlockCount(); ++node) {
    const int block_count = std::min(kBlockLanes, head_.BlockCount() - node * kBlockLanes);
    work.boxes += block_count;
    const BlockResult bounds = SquaredBounds(metric_, {query, query}, head_.boxes[node], limit);
    for (std::uint32_t kept = bounds.kept & LanesOf(block_count); kept != 0; kept &= kept - 1) {
      const int block = node * kBlockLanes + std::countr_zero(kept);
      const int count = std::min(kBlockLanes, head_.frame_count - block * kBlockLanes);
      work.distances += count;
      const BlockResult near = SquaredDistances(metric_, query, head_.frames[block], limit);
      for (std::uint32_t lanes = near.kept & LanesOf(count); lanes != 0; lanes &= lanes - 1) {
        const int lane = std::countr_zero(lanes);
        const double distance = std::sqrt(near.squared[lane]);
        if (distance < threshold) return Neighbour{block * kBlockLanes + lane, distance};
      }
    }
  }
  return std::nullopt;
}

void GradeIndex::FindFirst(int level, int node, FirstSearch& search) const {
  if (level < 0) {
    const BlockResult near = FramesWithin(node, search.query, search.threshold, search.work);
    ForEachLane(near.kept, [&](int lane) {
      const Neighbour found{order_[node * kBlockLanes + lane], std::sqrt(near.squared[lane])};
      if (found.distance < search.threshold && found.frame < search.best.frame) search.best = found;
    });
    return;
  }
  Children children = ChildrenWithin(level, node, search.query, search.threshold, search.work);
  std::ranges::sort(children, {}, &Child::first_frame);
  for (const Child& child : children) {
    if (child.first_frame >= search.best.frame) break;
    if (child.bound < search.threshold) FindFirst(level - 1, child.index, search);
  }
}

std::vector<Neighbour> GradeIndex::Within(const Grades& query, double threshold, SearchWork* work) const {
  if (frame_count_ == 0 || !(threshold > 0)) return {};
  WithinSearch search{.query = {query, query}, .threshold = threshold, .found = {}};
  FindWithin(TopLevel(), 0, search);
  AddWork(search.work, work);
  SortByFrame(search.found, frame_count_);
  return search.found;
}

void GradeIndex::FindWithin(int level, int node, WithinSearch& search) const {
  if (level < 0) {
    const BlockResult near = FramesWithin(node, search.query, search.threshold, search.work);
    ForEachLane(near.kept, [&](int lane) {
      const Neighbour found{order_[node * kBlockLanes + lane], std::sqrt(near.squared[lane])};
      if (found.distance < search.threshold) search.found.push_back(found);
    });
    return;
  }
  for (const Child& child : ChildrenWithin(level, node, search.query, search.threshold, search.work)) {
    if (child.bound < search.threshold) FindWithin(level - 1, child.index, search);
  }
}

TimeBlocks::TimeBlocks(std::span<const Grades> all) : frame_count(static_cast<int>(all.size())) {
  frames.resize(static_cast<std::size_t>(BlocksFor(all.size())));
  boxes.resize(static_cast<std::size_t>(BlocksFor(frames.size())));
  for (std::size_t b = 0; b < frames.size(); ++b) {
    const std::span<const Grades> own =
        all.subspan(b * kBlockLanes).first(std::min<std::size_t>(kBlockLanes, all.size() - b * kBlockLanes));
    for (std::size_t i = 0; i < own.size(); ++i) frames[b].Set(static_cast<int>(i), own[i]);
    boxes[b / kBlockLanes].Set(static_cast<int>(b % kBlockLanes), BoxOf(own));
  }
}

}  // namespace etude
