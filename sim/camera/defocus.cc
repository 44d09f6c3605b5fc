#include "sim/camera/defocus.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

/// out[i] (+)= weight · (a[i] + b[i]), float by float.
template <bool kAdd>
void Weigh(const float* a, const float* b, float weight, std::size_t count, float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float both = weight * (a[i] + b[i]);
    out[i] = kAdd ? out[i] + both : both;
  }
}

const float* Floats(const Light* light) { return &light->r; }
float* Floats(Light* light) { return &light->r; }

}  // namespace

Defocus::Defocus(double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_px));
  std::vector<double> exact;
  double sum = 0;
  for (int i = 0; i <= reach; ++i) {
    exact.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += (i == 0 ? 1 : 2) * exact.back();
  }
  // The middle is added to itself below.
  exact[0] /= 2;
  for (const double weight : exact) weights_.push_back(static_cast<float>(weight / sum));
}

void Defocus::Apply(LightImage& light) {
  const std::size_t width = static_cast<std::size_t>(light.width), reach = weights_.size() - 1, floats = 4 * width;
  if (across_.width != light.width || across_.height != light.height) across_ = LightImage(light.width, light.height);
  padded_row_.resize(width + 2 * reach);
  for (int y = 0; y < light.height; ++y) {
    const Light* row = &light.At(0, y);
    std::fill_n(padded_row_.begin(), reach, row[0]);
    std::copy_n(row, width, padded_row_.begin() + static_cast<std::ptrdiff_t>(reach));
    std::fill_n(padded_row_.end() - static_cast<std::ptrdiff_t>(reach), reach, row[width - 1]);
    const Light* middle = padded_row_.data() + reach;
    float* out = Floats(&across_.At(0, y));
    Weigh<false>(Floats(middle), Floats(middle), weights_[0], floats, out);
    for (std::size_t i = 1; i <= reach; ++i)
      Weigh<true>(Floats(middle - i), Floats(middle + i), weights_[i], floats, out);
  }
  const auto row_at = [&](int y) { return Floats(&across_.At(0, std::clamp(y, 0, light.height - 1))); };
  for (int y = 0; y < light.height; ++y) {
    float* out = Floats(&light.At(0, y));
    Weigh<false>(row_at(y), row_at(y), weights_[0], floats, out);
    for (int i = 1; i <= static_cast<int>(reach); ++i) {
      Weigh<true>(row_at(y - i), row_at(y + i), weights_[static_cast<std::size_t>(i)], floats, out);
    }
  }
}

}  // namespace etude
