#include "bench/metrics/catalogue.h"

#include <algorithm>
#include <array>
#include <vector>

namespace etude {

std::string_view DirectionWords(Direction direction) {
  constexpr std::array<std::string_view, 3> kWords = {"lower is better", "higher is better", ""};
  return kWords[static_cast<std::size_t>(direction)];
}

const MetricInfo* FindMetric(std::string_view id) {
  static const std::vector<const MetricInfo*> by_id = [] {
    std::vector<const MetricInfo*> sorted;
    for (const MetricInfo& metric : AllMetrics()) sorted.push_back(&metric);
    std::ranges::sort(sorted, {}, &MetricInfo::id);  // ids differ
    return sorted;
  }();
  const auto found =
      std::ranges::lower_bound(by_id, id, {}, [](const MetricInfo* metric) { return std::string_view(metric->id); });
  return found != by_id.end() && (*found)->id == id ? *found : nullptr;
}

}  // namespace etude
