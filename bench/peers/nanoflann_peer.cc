#include "bench/peers/nanoflann_peer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>

namespace etude {
namespace {

struct Cloud {
  std::vector<GradePoint> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t frame, std::size_t term) const { return points[frame][term]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud,
                                                   static_cast<int>(kTermCount), std::uint32_t>;

/// A result set for nanoflann: the first frame in time order within a distance.
class FirstFrame {
 public:
  FirstFrame(double squared_limit, std::span<const std::uint32_t> frame_of)
      : limit_(squared_limit), frame_of_(frame_of) {}
  bool full() const { return true; }
  double worstDist() const { return limit_; }
  bool addPoint(double squared, std::uint32_t point) {
    const std::uint32_t frame = frame_of_[point];
    if (squared < limit_ && frame < frame_) {
      frame_ = frame;
      squared_ = squared;
    }
    return true;
  }
  std::optional<Neighbour> Found() const {
    if (frame_ == kNone) return std::nullopt;
    return Neighbour{static_cast<int>(frame_), std::sqrt(squared_)};
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  double limit_;
  std::span<const std::uint32_t> frame_of_;
  std::uint32_t frame_ = kNone;
  double squared_ = 0;
};

}  // namespace

struct NanoflannPeer::Tree {
  Cloud cloud;
  std::vector<std::uint32_t> frame_of;  ///< the frame of each point
  std::unique_ptr<KdTree> kd_tree;

  void PutPointsInLeafOrder();
};

/// nanoflann reads points through a table of indices. If the points are stored in the order of its leaves, each leaf is
/// contiguous in memory.
void NanoflannPeer::Tree::PutPointsInLeafOrder() {
  frame_of = kd_tree->vAcc;
  std::vector<GradePoint> ordered;
  ordered.reserve(frame_of.size());
  for (std::uint32_t frame : frame_of) ordered.push_back(cloud.points[frame]);
  cloud.points = std::move(ordered);
  std::iota(kd_tree->vAcc.begin(), kd_tree->vAcc.end(), 0u);
}

NanoflannPeer::NanoflannPeer(std::span<const Grades> frames, const FeatureWeights& weights, int leaf_size)
    : roots_(RootsOf(weights)), tree_(std::make_unique<Tree>()) {
  for (const Grades& grades : frames) tree_->cloud.points.push_back(PointOf(grades, roots_));
  const nanoflann::KDTreeSingleIndexAdaptorParams params(static_cast<std::size_t>(leaf_size));
  tree_->kd_tree = std::make_unique<KdTree>(static_cast<int>(kTermCount), tree_->cloud, params);
  tree_->kd_tree->buildIndex();
  tree_->PutPointsInLeafOrder();
}

NanoflannPeer::~NanoflannPeer() = default;

std::optional<Neighbour> NanoflannPeer::First(const Grades& query, double threshold) const {
  const GradePoint point = PointOf(query, roots_);
  FirstFrame first(threshold * threshold, tree_->frame_of);
  tree_->kd_tree->findNeighbors(first, point.data(), {});
  return first.Found();
}

std::vector<Neighbour> NanoflannPeer::Within(const Grades& query, double threshold) const {
  const GradePoint point = PointOf(query, roots_);
  std::vector<std::pair<std::uint32_t, double>> near;
  nanoflann::SearchParams unsorted;
  unsorted.sorted = false;
  tree_->kd_tree->radiusSearch(point.data(), threshold * threshold, near, unsorted);
  std::vector<Neighbour> found;
  for (const auto& [point_found, squared] : near) {
    found.push_back({static_cast<int>(tree_->frame_of[point_found]), std::sqrt(squared)});
  }
  std::ranges::sort(found, {}, &Neighbour::frame);
  return found;
}

std::vector<Neighbour> NanoflannPeer::Nearest(const Grades& query, int k) const {
  const GradePoint point = PointOf(query, roots_);
  std::vector<std::uint32_t> points(static_cast<std::size_t>(k));
  std::vector<double> squared(points.size());
  const std::size_t count = tree_->kd_tree->knnSearch(point.data(), points.size(), points.data(), squared.data());
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < count; ++i) {
    found.push_back({static_cast<int>(tree_->frame_of[points[i]]), std::sqrt(squared[i])});
  }
  return found;
}

std::size_t NanoflannPeer::Bytes() const {
  return tree_->cloud.points.size() * (sizeof(GradePoint) + sizeof(std::uint32_t)) +
         tree_->kd_tree->usedMemory(*tree_->kd_tree);
}

}  // namespace etude
