#pragma once

#include <optional>
#include <span>

namespace etude {

/// LDLJ, the log dimensionless jerk of a speed profile (Balasubramanian et al. 2012, 2015): the higher, the smoother.
/// Without a unit: neither the speed's size nor the samples' rate counts, only its shape. Empty when there are fewer
/// than three samples, when nothing moves, and when the speed has no jerk (a straight line over time).
std::optional<double> LogDimensionlessJerk(std::span<const double> speed);

}  // namespace etude
