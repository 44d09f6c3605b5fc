#include "bench/metrics/annotation.h"

#include <cstdint>

#include "bench/statistics/curves/curves.h"

namespace etude {

std::optional<double> AnnotatorDistancePx(std::span<const MarkedTwice> joints) {
  double sum = 0;
  int count = 0;
  for (const auto& [first, second] : joints) {
    if (!first || !second) continue;
    sum += glm::distance(*first, *second);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::optional<double> AnnotatorOverlap(std::span<const MarkedTwice> limbs) {
  std::int64_t both = 0, either = 0;
  for (const auto& [first, second] : limbs) {
    both += first && second;
    either += first || second;
  }
  return Share(both, either);
}

}  // namespace etude
