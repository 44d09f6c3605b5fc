#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// Returns SPARC, the spectral arc length of a speed profile (Balasubramanian et al. 2015). 0 is the smoothest; less
/// smooth profiles have larger negative values. The amplitude threshold is 0.05, the cut-off frequency 10 Hz, and the
/// padding level 4. Empty for fewer than two samples, if nothing moves, or if only one frequency bin reaches the
/// threshold.
std::optional<double> SpectralArcLength(std::span<const double> speed, double rate_hz);

/// Returns the speed profile from which a transition's SPARC is computed, metres per second: the mean over joints of
/// the speed between each frame and the next. It covers the frames `first` to `last`, clamped to the motion.
std::vector<double> MeanJointSpeed(const BodyMotion& motion, int first, int last);

/// Returns LDLJ, the log dimensionless jerk of a speed profile (Balasubramanian et al. 2012, 2015): higher is smoother.
/// It depends only on the shape of the profile, not on the size of the speed or on the sample rate. Empty for fewer
/// than three samples, if nothing moves, or if the profile is a straight line over time (no jerk).
std::optional<double> LogDimensionlessJerk(std::span<const double> speed);

}  // namespace etude
