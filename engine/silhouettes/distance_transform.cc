#include "engine/silhouettes/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace etude {
namespace {

// The lower envelope of the parabolas (x − q)² + heights[q] (the paper's DT1D), with room for `size` of them.
class Envelope {
 public:
  explicit Envelope(int size) : apex_(size), begins_(size + 1) {}

  // out[x] = min over q of (x − q)² + heights[q]; heights of `kNone` count as infinite.
  void Fill(const std::vector<double>& heights, int size, std::vector<double>& out) {
    int last = -1;
    for (int q = 0; q < size; ++q) {
      if (heights[q] >= kNone) continue;
      double begin = -kNone;
      while (last >= 0) {
        const int p = apex_[last];
        begin = ((heights[q] + q * q) - (heights[p] + p * p)) / (2.0 * (q - p));
        if (begin > begins_[last]) break;
        --last;
      }
      if (last < 0) begin = -kNone;
      ++last;
      apex_[last] = q;
      begins_[last] = begin;
      begins_[last + 1] = kNone;
    }
    if (last < 0) {
      std::fill_n(out.begin(), size, kNone);
      return;
    }
    int at = 0;
    for (int x = 0; x < size; ++x) {
      while (begins_[at + 1] < x) ++at;
      const double along = x - apex_[at];
      out[x] = along * along + heights[apex_[at]];
    }
  }

  static constexpr double kNone = 1e18;

 private:
  std::vector<int> apex_;
  std::vector<double> begins_;  // where each parabola becomes the lowest
};

// Of every pixel, the squared distance to the nearest one whose mask value is `value`.
std::vector<double> SquaredDistancesTo(const Mask& mask, std::uint8_t value) {
  const int width = mask.width, height = mask.height;
  const int longest = std::max(width, height);
  std::vector<double> squared(mask.pixels.size());
  // Down the columns distances are counted; along the rows the envelope joins them.
  for (int x = 0; x < width; ++x) {
    double steps = Envelope::kNone;
    const auto walk = [&](int y) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      steps = mask.pixels[i] == value ? 0 : steps + 1;
      return i;
    };
    for (int y = 0; y < height; ++y) {
      const std::size_t i = walk(y);
      squared[i] = steps;
    }
    steps = Envelope::kNone;
    for (int y = height - 1; y >= 0; --y) {
      const std::size_t i = walk(y);
      const double nearest = std::min(squared[i], steps);
      squared[i] = nearest >= Envelope::kNone ? Envelope::kNone : nearest * nearest;
    }
  }
  Envelope envelope(longest);
  std::vector<double> row(longest), out(longest);
  for (int y = 0; y < height; ++y) {
    double* const begin = squared.data() + static_cast<std::size_t>(y) * width;
    std::copy_n(begin, width, row.begin());
    envelope.Fill(row, width, out);
    std::copy_n(out.begin(), width, begin);
  }
  return squared;
}

}  // namespace

Image<float> SignedDistances(const Mask& mask) {
  const std::vector<double> to_set = SquaredDistancesTo(mask, 1), to_unset = SquaredDistancesTo(mask, 0);
  Image<float> distances(mask.width, mask.height);
  const double farthest = mask.width + mask.height;
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    const bool inside = mask.pixels[i] != 0;
    const double away = std::min(std::sqrt(inside ? to_unset[i] : to_set[i]) - 0.5, farthest);
    distances.pixels[i] = static_cast<float>(inside ? -away : away);
  }
  return distances;
}

}  // namespace etude
