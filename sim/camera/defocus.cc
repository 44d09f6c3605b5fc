#include "sim/camera/defocus.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace etude {
namespace {

constexpr int kMostUnrolled = 6;

/// Rows of floats about the middle one: rows[reach + i] is i away.
using Rows = const float* const*;

/// out[i] = Σ weights[k] · (row −k [i] + row k [i]), k = 0 … kReach, in one pass.
template <int kReach>
void WeighUnrolled(Rows rows, const float* weights, std::size_t count, float* __restrict out) {
  std::array<float, kReach + 1> w;
  std::array<const float*, 2 * kReach + 1> row;
  std::copy_n(weights, w.size(), w.begin());
  std::copy_n(rows, row.size(), row.begin());
  for (std::size_t i = 0; i < count; ++i) {
    float sum = w[0] * (row[kReach][i] + row[kReach][i]);
#pragma GCC unroll 8
    for (int k = 1; k <= kReach; ++k) sum += w[k] * (row[kReach - k][i] + row[kReach + k][i]);
    out[i] = sum;
  }
}

/// The same for any reach, pass by pass; the sums have the same order.
void WeighInPasses(Rows rows, int reach, const float* weights, std::size_t count, float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = weights[0] * (rows[reach][i] + rows[reach][i]);
  for (int k = 1; k <= reach; ++k) {
    const float *before = rows[reach - k], *behind = rows[reach + k];
    for (std::size_t i = 0; i < count; ++i) out[i] += weights[k] * (before[i] + behind[i]);
  }
}

void Weigh(Rows rows, int reach, const float* weights, std::size_t count, float* out) {
  switch (reach) {
    case 1:
      return WeighUnrolled<1>(rows, weights, count, out);
    case 2:
      return WeighUnrolled<2>(rows, weights, count, out);
    case 3:
      return WeighUnrolled<3>(rows, weights, count, out);
    case 4:
      return WeighUnrolled<4>(rows, weights, count, out);
    case 5:
      return WeighUnrolled<5>(rows, weights, count, out);
    case kMostUnrolled:
      return WeighUnrolled<kMostUnrolled>(rows, weights, count, out);
    default:
      return WeighInPasses(rows, reach, weights, count, out);
  }
}

}  // namespace

Defocus::Defocus(double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_px));
  std::vector<double> exact;
  double sum = 0;
  for (int i = 0; i <= reach; ++i) {
    exact.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += (i == 0 ? 1 : 2) * exact.back();
  }
  // The middle is added to itself.
  exact[0] /= 2;
  for (const double weight : exact) weights_.push_back(static_cast<float>(weight / sum));
}

void Defocus::BlurAcross(const Light* row, std::size_t width, Light* out) {
  const std::size_t reach = weights_.size() - 1;
  padded_row_.resize(width + 2 * reach);
  std::fill_n(padded_row_.begin(), reach, row[0]);
  std::copy_n(row, width, padded_row_.data() + reach);
  std::fill_n(padded_row_.data() + reach + width, reach, row[width - 1]);
  rows_.clear();
  for (std::size_t i = 0; i <= 2 * reach; ++i) rows_.push_back(&padded_row_[i].r);
  Weigh(rows_.data(), static_cast<int>(reach), weights_.data(), 4 * width, &out->r);
}

void Defocus::Apply(LightImage& light) {
  const int reach = static_cast<int>(weights_.size()) - 1, height = light.height, kept = 2 * reach + 1;
  const std::size_t width = static_cast<std::size_t>(light.width);
  // Rows blurred across, as many as one row needs about it.
  across_.resize(static_cast<std::size_t>(kept) * width);
  const auto across = [&](int y) { return across_.data() + static_cast<std::size_t>(y % kept) * width; };
  int done = 0;
  for (int y = 0; y < height; ++y) {
    for (; done < std::min(y + reach + 1, height); ++done) BlurAcross(&light.At(0, done), width, across(done));
    rows_.clear();
    for (int i = -reach; i <= reach; ++i) rows_.push_back(&across(std::clamp(y + i, 0, height - 1))->r);
    Weigh(rows_.data(), reach, weights_.data(), 4 * width, &light.At(0, y).r);
  }
}

}  // namespace etude
