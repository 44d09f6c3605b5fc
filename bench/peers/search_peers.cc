#include "bench/peers/search_peers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace etude {
namespace {

/// Returns d², or a partial sum as soon as it reaches `limit`. The number of terms per step is fixed, so that the
/// compiler can use SIMD.
double SquaredDistance(const GradePoint& a, const GradePoint& b, double limit) {
  constexpr std::size_t kTermsPerStep = 8;
  double sum = 0;
  for (std::size_t from = 0; from < kTermCount; from += kTermsPerStep) {
    std::array<double, 2> sums{};
    for (std::size_t t = from; t < from + kTermsPerStep; t += 2) {
      for (std::size_t i = 0; i < 2; ++i) {
        const double gap = a[t + i] - b[t + i];
        sums[i] += gap * gap;
      }
    }
    sum += sums[0] + sums[1];
    if (sum >= limit) return sum;
  }
  return sum;
}

/// The k nearest of the frames seen so far, in time order.
class BestFrames {
 public:
  explicit BestFrames(int k) : k_(static_cast<std::size_t>(k)) {}
  double Limit() const { return best_.size() < k_ ? std::numeric_limits<double>::infinity() : best_.back().distance; }
  void Offer(int frame, double squared) {
    if (!(squared < Limit())) return;
    const auto place = std::ranges::upper_bound(best_, squared, {}, &Neighbour::distance);
    best_.insert(place, {frame, squared});
    if (best_.size() > k_) best_.pop_back();
  }
  std::vector<Neighbour> Take() {
    for (Neighbour& neighbour : best_) neighbour.distance = std::sqrt(neighbour.distance);
    return std::move(best_);
  }

 private:
  std::size_t k_;
  std::vector<Neighbour> best_;
};

}  // namespace

GradePoint RootsOf(const FeatureWeights& weights) {
  GradePoint roots{};
  for (std::size_t t = 0; t < kTermCount; ++t) {
    roots[t] = std::sqrt(weights[static_cast<std::size_t>(AllTerms()[t].feature)]);
  }
  return roots;
}

GradePoint PointOf(const Grades& grades, const GradePoint& roots) {
  GradePoint point{};
  for (std::size_t t = 0; t < kTermCount; ++t) point[t] = roots[t] * grades[t];
  return point;
}

LoopPeer::LoopPeer(std::span<const Grades> frames, const FeatureWeights& weights) : roots_(RootsOf(weights)) {
  for (const Grades& grades : frames) points_.push_back(PointOf(grades, roots_));
}

std::optional<Neighbour> LoopPeer::First(const Grades& query, double threshold) const {
  const GradePoint point = PointOf(query, roots_);
  const double limit = threshold * threshold;
  for (std::size_t f = 0; f < points_.size(); ++f) {
    const double squared = SquaredDistance(points_[f], point, limit);
    if (squared < limit) return Neighbour{static_cast<int>(f), std::sqrt(squared)};
  }
  return std::nullopt;
}

std::vector<Neighbour> LoopPeer::Within(const Grades& query, double threshold) const {
  const GradePoint point = PointOf(query, roots_);
  const double limit = threshold * threshold;
  std::vector<Neighbour> found;
  for (std::size_t f = 0; f < points_.size(); ++f) {
    const double squared = SquaredDistance(points_[f], point, limit);
    if (squared < limit) found.push_back({static_cast<int>(f), std::sqrt(squared)});
  }
  return found;
}

std::vector<Neighbour> LoopPeer::Nearest(const Grades& query, int k) const {
  const GradePoint point = PointOf(query, roots_);
  BestFrames best(k);
  for (std::size_t f = 0; f < points_.size(); ++f) {
    best.Offer(static_cast<int>(f), SquaredDistance(points_[f], point, best.Limit()));
  }
  return best.Take();
}

VectorLoopPeer::VectorLoopPeer(std::span<const Grades> frames, const FeatureWeights& weights)
    : metric_(weights), frame_count_(static_cast<int>(frames.size())) {
  blocks_.resize((frames.size() + kBlockLanes - 1) / kBlockLanes);
  for (std::size_t f = 0; f < blocks_.size() * kBlockLanes; ++f) {
    for (std::size_t t = 0; t < kTermCount; ++t) {
      // Lanes beyond the last frame get grades that are too far from every query.
      blocks_[f / kBlockLanes].grades[t][f % kBlockLanes] = f < frames.size() ? frames[f][t] : 1e9;
    }
  }
}

std::optional<Neighbour> VectorLoopPeer::First(const Grades& query, double threshold) const {
  const double limit = std::nextafter(threshold * threshold, 0);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const BlockResult result = SquaredDistances(metric_, query, blocks_[b], limit);
    if (result.kept == 0) continue;
    const int lane = std::countr_zero(result.kept);
    return Neighbour{static_cast<int>(b) * kBlockLanes + lane, std::sqrt(result.squared[lane])};
  }
  return std::nullopt;
}

std::vector<Neighbour> VectorLoopPeer::Within(const Grades& query, double threshold) const {
  const double limit = std::nextafter(threshold * threshold, 0);
  std::vector<Neighbour> found;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const BlockResult result = SquaredDistances(metric_, query, blocks_[b], limit);
    for (std::uint32_t kept = result.kept; kept != 0; kept &= kept - 1) {
      const int lane = std::countr_zero(kept);
      found.push_back({static_cast<int>(b) * kBlockLanes + lane, std::sqrt(result.squared[lane])});
    }
  }
  return found;
}

std::vector<Neighbour> VectorLoopPeer::Nearest(const Grades& query, int k) const {
  BestFrames best(std::min(k, frame_count_));
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const BlockResult result = SquaredDistances(metric_, query, blocks_[b], best.Limit());
    for (std::uint32_t kept = result.kept; kept != 0; kept &= kept - 1) {
      const int lane = std::countr_zero(kept);
      best.Offer(static_cast<int>(b) * kBlockLanes + lane, result.squared[lane]);
    }
  }
  return best.Take();
}

}  // namespace etude
