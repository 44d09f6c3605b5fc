#include "bench/metrics/catalogue.h"

namespace etude {

std::string_view DirectionWords(Direction direction) {
  switch (direction) {
    case Direction::kLowerIsBetter:
      return "lower is better";
    case Direction::kHigherIsBetter:
      return "higher is better";
    case Direction::kNeither:
      break;
  }
  return "";
}

const MetricInfo* FindMetric(std::string_view id) {
  for (const MetricInfo& metric : AllMetrics()) {
    if (metric.id == id) return &metric;
  }
  return nullptr;
}

}  // namespace etude
