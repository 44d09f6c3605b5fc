#pragma once

#include <glm/glm.hpp>

#include "sim/random/stream.h"

namespace etude {

/// A stationary process of three independent axes, each of unit variance: white noise through one first-order low
/// pass (Ornstein–Uhlenbeck, correlation exp(−t/τ)), or through two.
class SlowNoise {
 public:
  /// `time_s`: the longer time constant; `smoothing_s`: the shorter, 0 = one low pass only. Starts stationary.
  SlowNoise(double time_s, double smoothing_s, double rate_hz, RandomStream& dice);

  /// The next frame's value; three throws.
  glm::dvec3 Next(RandomStream& dice);

 private:
  double memory_, smoothing_, scale_;
  glm::dvec3 first_{0}, second_{0};
};

/// Short noise in bursts: unit variance over long times, heavy tails. Kurtosis 3 exp(4 tail²).
class BurstNoise {
 public:
  BurstNoise(double time_s, double tail, double rate_hz, RandomStream& dice);

  /// Six throws.
  glm::dvec3 Next(RandomStream& dice);

 private:
  double tail_;
  SlowNoise noise_, loudness_;
};

}  // namespace etude
