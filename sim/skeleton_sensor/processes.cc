#include "sim/skeleton_sensor/processes.h"

#include <cmath>

namespace etude {
namespace {

/// How a first-order low pass keeps its value over one frame; a time constant of 0 keeps nothing.
double MemoryOf(double time_s, double rate_hz) { return time_s > 0 ? std::exp(-1.0 / (rate_hz * time_s)) : 0.0; }

constexpr double kLoudnessTime = 0.7;  // seconds that a burst lasts, about (ours)

}  // namespace

SlowNoise::SlowNoise(double time_s, double smoothing_s, double rate_hz, RandomStream& dice)
    : memory_(MemoryOf(time_s, rate_hz)), smoothing_(MemoryOf(smoothing_s, rate_hz)) {
  // The variance of a second low pass (s) behind a unit AR(1) (m): (1 − s) (1 + s m) / ((1 + s) (1 − s m)).
  const double s = smoothing_, m = memory_;
  scale_ = std::sqrt((1 + s) * (1 - s * m) / ((1 - s) * (1 + s * m)));
  // The joint stationary law of both: variances 1 and 1/scale², covariance (1 − s) / (1 − s m).
  const glm::dvec3 a = dice.Normal3(), b = dice.Normal3();
  const double covariance = (1 - s) / (1 - s * m);
  const double rest = std::max(0.0, 1 / (scale_ * scale_) - covariance * covariance);
  first_ = a;
  second_ = covariance * a + std::sqrt(rest) * b;
}

glm::dvec3 SlowNoise::Next(RandomStream& dice) {
  first_ = memory_ * first_ + std::sqrt(1 - memory_ * memory_) * dice.Normal3();
  second_ = smoothing_ * second_ + (1 - smoothing_) * first_;
  return scale_ * second_;
}

BurstNoise::BurstNoise(double time_s, double tail, double rate_hz, RandomStream& dice)
    : tail_(tail), noise_(time_s, 0, rate_hz, dice), loudness_(kLoudnessTime, 0, rate_hz, dice) {}

glm::dvec3 BurstNoise::Next(RandomStream& dice) {
  const glm::dvec3 noise = noise_.Next(dice);
  // Log-normal of unit mean square, the same along all axes.
  const double loudness = std::exp(tail_ * loudness_.Next(dice).x - tail_ * tail_);
  return loudness * noise;
}

}  // namespace etude
