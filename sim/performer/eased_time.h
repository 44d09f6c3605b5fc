#pragma once

#include <algorithm>

namespace etude {

/// How long the way from standing into a move takes, and back.
constexpr double kBlendSeconds = 0.45;

/// A performance's clock, seconds: runs with time between 0 and `length`, gathers way in the blend before, and comes to
/// rest in the blend after, so that nothing starts or stops at a jerk.
inline double EasedTime(double time, double length) {
  if (time < 0) {
    const double t = std::max(time, -kBlendSeconds) + kBlendSeconds;
    return 0.5 * t * t / kBlendSeconds - 0.5 * kBlendSeconds;
  }
  if (time > length) return length - EasedTime(length - time, length);
  return time;
}

}  // namespace etude
