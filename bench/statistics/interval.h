#pragma once

#include "bench/model/summary.h"

namespace etude {

constexpr double kConfidence = 0.95;
constexpr double kAlpha = 1 - kConfidence;

/// A confidence interval, and how it was computed.
struct Interval {
  double low = 0;
  double high = 0;
  IntervalKind kind = IntervalKind::kBca;
};

}  // namespace etude
