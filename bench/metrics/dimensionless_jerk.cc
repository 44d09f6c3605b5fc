#include "bench/metrics/dimensionless_jerk.h"

#include <algorithm>
#include <cmath>

namespace etude {

std::optional<double> LogDimensionlessJerk(std::span<const double> speed) {
  double peak = 0;
  for (double v : speed) peak = std::max(peak, std::abs(v));
  double squares = 0;  // of the second differences: the jerk is the second derivative of the speed
  for (std::size_t i = 2; i < speed.size(); ++i) {
    const double difference = speed[i] - 2 * speed[i - 1] + speed[i - 2];
    squares += difference * difference;
  }
  if (peak <= 0 || squares <= 0) return std::nullopt;
  // (N dt)³ / peak² · Σ (difference / dt²)² dt, in which the time between samples, dt, cancels.
  const auto samples = static_cast<double>(speed.size());
  return -std::log(samples * samples * samples * squares / (peak * peak));
}

}  // namespace etude
