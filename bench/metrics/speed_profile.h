#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// SPARC, the spectral arc length of a speed profile (Balasubramanian et al. 2015): 0 at best, more
/// negative the less smooth. Amplitude threshold 0.05, cut-off 10 Hz, padding 4. Empty when there are
/// fewer than two samples or nothing moves.
std::optional<double> SpectralArcLength(std::span<const double> speed, double rate_hz);

/// The speed that SPARC judges a transition by: the mean over joints of the speed between each frame and
/// the next, from `first` to `last` of the motion (clamped to it), metres per second.
std::vector<double> MeanJointSpeed(const BodyMotion& motion, int first, int last);

/// LDLJ, the log dimensionless jerk of a speed profile (Balasubramanian et al. 2012, 2015): the higher, the smoother.
/// Without a unit: neither the speed's size nor the samples' rate counts, only its shape. Empty when there are fewer
/// than three samples, when nothing moves, and when the speed has no jerk (a straight line over time).
std::optional<double> LogDimensionlessJerk(std::span<const double> speed);

}  // namespace etude
