#include "engine/transitions/search/block_order.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

namespace etude {
namespace {

/// A frame and its place along the axis of a split.
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
    // The left side gets a power of two of blocks, so that each block, and each group of sixteen, is a subtree.
    const std::size_t blocks = (order.size() + kBlockLanes - 1) / kBlockLanes;
    const std::size_t left = std::bit_ceil(blocks) / 2 * kBlockLanes;
    std::ranges::nth_element(placed, placed.begin() + static_cast<std::ptrdiff_t>(left), {},
                             [](const Placed& p) { return std::tuple(p.at, p.frame); });
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = placed[i].frame;
    Split(order.first(left));
    Split(order.subspan(left));
  }

 private:
  /// The term whose weighted grades vary most, judged by some of the frames.
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
    double most = -1;
    for (std::size_t t = 0; t < kTermCount; ++t) {
      const double variance = weights_[t] * (squares[t] - sum[t] * sum[t] / count);
      if (variance > most) {
        most = variance;
        widest = t;
      }
    }
    return widest;
  }

  std::span<const Grades> frames_;
  Grades weights_{};
  std::vector<Placed> placed_;
};

}  // namespace

std::vector<int> OrderForBlocks(std::span<const Grades> frames, const GradeMetric& metric) {
  std::vector<int> order(frames.size());
  std::iota(order.begin(), order.end(), 0);
  Splitter(frames, metric).Split(order);
  return order;
}

}  // namespace etude
