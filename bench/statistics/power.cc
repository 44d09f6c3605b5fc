#include "bench/statistics/power.h"

#include <cmath>

#include "bench/statistics/distributions.h"
#include "bench/statistics/interval.h"

namespace etude {

double SmallestFinding(int count, int comparisons) {
  constexpr double kPower = 0.8;
  const double tail = kAlpha / (2 * comparisons);
  return (StudentQuantile(1 - tail, count - 1) + StudentQuantile(kPower, count - 1)) / std::sqrt(count);
}

}  // namespace etude
