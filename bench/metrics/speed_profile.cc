#include "bench/metrics/speed_profile.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr double kCutOffHz = 10;
constexpr double kAmplitudeThreshold = 0.05;
constexpr int kPadding = 4;

/// Returns the magnitudes of the zero-padded spectrum up to the cut-off frequency. The few bins are computed one by
/// one, without an FFT.
std::vector<double> Magnitudes(std::span<const double> speed, std::size_t padded_size, double rate_hz) {
  const double hz_per_bin = rate_hz / static_cast<double>(padded_size);
  std::vector<double> magnitudes;
  for (std::size_t bin = 0; bin < padded_size && static_cast<double>(bin) * hz_per_bin <= kCutOffHz; ++bin) {
    double re = 0, im = 0;
    for (std::size_t i = 0; i < speed.size(); ++i) {
      const double phase = 2 * kPi * static_cast<double>(bin * i % padded_size) / static_cast<double>(padded_size);
      re += speed[i] * std::cos(phase);
      im -= speed[i] * std::sin(phase);
    }
    magnitudes.push_back(std::sqrt(re * re + im * im));
  }
  return magnitudes;
}

}  // namespace

std::optional<double> SpectralArcLength(std::span<const double> speed, double rate_hz) {
  if (speed.size() < 2) return std::nullopt;
  // Compute the normalised magnitude spectrum up to the cut-off.
  const std::size_t padded_size = std::bit_ceil(speed.size()) << kPadding;
  std::vector<double> magnitudes = Magnitudes(speed, padded_size, rate_hz);
  const double largest = *std::max_element(magnitudes.begin(), magnitudes.end());
  if (largest <= 0) return std::nullopt;
  for (double& magnitude : magnitudes) magnitude /= largest;

  // Sum the arc length between the first and the last bin above the threshold.
  const auto is_loud = [](double magnitude) { return magnitude >= kAmplitudeThreshold; };
  const auto first = std::find_if(magnitudes.begin(), magnitudes.end(), is_loud);
  const auto last = std::find_if(magnitudes.rbegin(), magnitudes.rend(), is_loud).base() - 1;
  if (first == last) return std::nullopt;
  const double bin_share = 1.0 / static_cast<double>(last - first);
  double length = 0;
  for (auto bin = first; bin != last; ++bin) {
    const double rise = *(bin + 1) - *bin;
    length += std::sqrt(bin_share * bin_share + rise * rise);
  }
  return -length;
}

std::vector<double> MeanJointSpeed(const BodyMotion& motion, int first, int last) {
  std::vector<double> speeds;
  const int end = std::min(last, static_cast<int>(motion.poses.size()) - 1);
  for (int frame = std::max(first, 0); frame < end; ++frame) {
    double sum = 0;
    for (Role role : AllRoles()) sum += glm::distance(motion.poses[frame][role], motion.poses[frame + 1][role]);
    speeds.push_back(sum / kRoleCount * motion.rate_hz);
  }
  return speeds;
}

std::optional<double> LogDimensionlessJerk(std::span<const double> speed) {
  double peak = 0;
  for (double v : speed) peak = std::max(peak, std::abs(v));
  double squares = 0;  // sum of the squared second differences: the jerk is the second derivative of the speed
  for (std::size_t i = 2; i < speed.size(); ++i) {
    const double difference = speed[i] - 2 * speed[i - 1] + speed[i - 2];
    squares += difference * difference;
  }
  if (peak <= 0 || squares <= 0) return std::nullopt;
  // Compute (N dt)³ / peak² · Σ (difference / dt²)² dt. The time between samples, dt, cancels.
  const auto samples = static_cast<double>(speed.size());
  return -std::log(samples * samples * samples * squares / (peak * peak));
}

}  // namespace etude
