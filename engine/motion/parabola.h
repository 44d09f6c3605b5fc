#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace etude {

/// A parabola fitted to the height of the centre of mass.
struct Parabola {
  double fall = 0;   ///< downward acceleration, metres per second²
  double stray = 0;  ///< root mean square deviation, metres
};

/// Fits a parabola to heights at equal time steps by least squares, with orthogonal polynomials.
inline Parabola FitParabola(std::span<const double> heights, double rate_hz) {
  const auto count = static_cast<double>(heights.size());
  const auto time = [&](std::size_t i) { return (static_cast<double>(i) - 0.5 * (count - 1)) / rate_hz; };
  double mean = 0, mean_square = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    mean += heights[i] / count;
    mean_square += time(i) * time(i) / count;
  }
  double rise = 0, bend = 0, bend_norm = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double t = time(i), square = t * t - mean_square;
    rise += t * heights[i] / (mean_square * count);
    bend += square * heights[i];
    bend_norm += square * square;
  }
  bend /= bend_norm;
  double stray = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double t = time(i), off = heights[i] - (mean + rise * t + bend * (t * t - mean_square));
    stray += off * off / count;
  }
  return {-2 * bend, std::sqrt(stray)};
}

}  // namespace etude
