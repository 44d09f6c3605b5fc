#pragma once

#include "bench/model/summary.h"

namespace etude {

constexpr double kConfidence = 0.95;
constexpr double kAlpha = 1 - kConfidence;

/// A confidence interval and the method by which it was computed.
struct Interval {
  double low = 0;
  double high = 0;
  IntervalKind kind = IntervalKind::kBca;
};

/// Returns Wilson's score interval (1927) of the share `count` / `of`. For the shares 0 and 1 it still has a width,
/// where a bootstrap interval has none. `of` > 0.
Interval WilsonInterval(int count, int of, double confidence = kConfidence);

/// Returns the interval of the difference of two shares measured on the same worlds, (gained − lost) / pairs. It is the
/// adjusted Wald interval (Bonett & Price 2012), which adds one fictitious world to each kind of disagreement. `pairs`
/// > 0.
Interval PairedShareInterval(int gained, int lost, int pairs, double confidence = kConfidence);

}  // namespace etude
