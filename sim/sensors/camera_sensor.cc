#include "sim/sensors/camera_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace etude {
namespace {

constexpr int kTableBits = 12;
constexpr int kTableSize = 1 << kTableBits;
using NormalTable = std::array<float, kTableSize>;

// The x below which a standard normal falls with this probability (0 < p < 1/2): Newton's method, which
// from 0 walks down the convex half of the distribution without overshooting.
double LowerQuantile(double probability) {
  double x = 0;
  for (int i = 0; i < 40; ++i) {
    const double below = 0.5 * std::erfc(-x / std::numbers::sqrt2);
    const double density = std::exp(-0.5 * x * x) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    x -= (below - probability) / density;
  }
  return x;
}

// The middle of each of 4096 equally likely slices of the standard normal.
NormalTable MakeNormalTable() {
  NormalTable table;
  for (int i = 0; i < kTableSize / 2; ++i) {
    const double x = LowerQuantile((i + 0.5) / kTableSize);
    table[i] = static_cast<float>(x);
    table[kTableSize - 1 - i] = static_cast<float>(-x);
  }
  return table;
}

// What every 8-bit value becomes before rounding: its mean and its deviation.
struct Response {
  float mean;
  float deviation;
};

std::array<Response, 256> MakeResponses(const CameraNoise& options, double gain) {
  std::array<Response, 256> responses;
  for (int value = 0; value < 256; ++value) {
    const double mean = value * gain;
    const double photons = options.photon_noise * options.photon_noise * std::max(mean, 0.0) / 255;
    responses[value] = {static_cast<float>(mean),
                        static_cast<float>(std::sqrt(options.read_noise * options.read_noise + photons))};
  }
  return responses;
}

// Five table entries out of each 64 random bits.
class NormalDraws {
 public:
  NormalDraws(const NormalTable& table, RandomStream& random) : table_(table), random_(random) {}
  float Next() {
    if (left_ == 0) {
      bits_ = random_.Bits();
      left_ = 64 / kTableBits;
    }
    const float value = table_[bits_ & (kTableSize - 1)];
    bits_ >>= kTableBits;
    --left_;
    return value;
  }

 private:
  const NormalTable& table_;
  RandomStream& random_;
  std::uint64_t bits_ = 0;
  int left_ = 0;
};

}  // namespace

ColourImage AddCameraNoise(const ColourImage& image, const CameraNoise& options, RandomStream& random) {
  static const NormalTable kNormals = MakeNormalTable();
  const double gain = 1.0 + options.exposure_deviation * random.Normal();
  const std::array<Response, 256> responses = MakeResponses(options, gain);
  NormalDraws normals(kNormals, random);

  ColourImage noisy = image;
  const auto disturb = [&](std::uint8_t& value) {
    const Response& response = responses[value];
    const float seen = response.mean + response.deviation * normals.Next();
    value = static_cast<std::uint8_t>(std::clamp(seen + 0.5f, 0.0f, 255.0f));
  };
  for (Rgb8& pixel : noisy.pixels) {
    disturb(pixel.r);
    disturb(pixel.g);
    disturb(pixel.b);
  }
  return noisy;
}

}  // namespace etude
