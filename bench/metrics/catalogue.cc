#include "bench/metrics/catalogue.h"

#include <algorithm>
#include <array>
#include <vector>

namespace etude {
namespace {

std::map<std::string, MetricInfo, std::less<>>& Added() {
  static std::map<std::string, MetricInfo, std::less<>> added;
  return added;
}

const MetricInfo* FindInCatalogue(std::string_view id) {
  static const std::vector<const MetricInfo*> by_id = [] {
    std::vector<const MetricInfo*> sorted;
    for (const MetricInfo& metric : AllMetrics()) sorted.push_back(&metric);
    std::ranges::sort(sorted, {}, &MetricInfo::id);  // ids are unique
    return sorted;
  }();
  const auto found =
      std::ranges::lower_bound(by_id, id, {}, [](const MetricInfo* metric) { return std::string_view(metric->id); });
  return found != by_id.end() && (*found)->id == id ? *found : nullptr;
}

/// Returns the name of the first field that differs between two definitions and affects how values are judged or drawn;
/// "" if no such field differs.
std::string FindDifference(const MetricInfo& a, const MetricInfo& b) {
  if (a.version != b.version) return fmt::format("version {} and {}", a.version, b.version);
  if (a.direction != b.direction) return "direction";
  if (a.unit != b.unit) return fmt::format("unit '{}' and '{}'", a.unit, b.unit);
  if (a.aggregate != b.aggregate) return "aggregate";
  if (a.reading != b.reading) return "reads";
  if (a.practical != b.practical) return fmt::format("practical {} and {}", a.practical, b.practical);
  return a.label != b.label ? "label" : a.definition != b.definition ? "definition" : "";
}

}  // namespace

std::string_view DirectionWords(Direction direction) {
  constexpr std::array<std::string_view, 3> kWords = {"lower is better", "higher is better", ""};
  return kWords[static_cast<std::size_t>(direction)];
}

Result<void> AddMetric(MetricInfo metric) {
  if (FindInCatalogue(metric.id) != nullptr)
    return Fail({}, "'{}' is the id of a built-in metric; allowed: another id", metric.id);
  const auto [known, is_new] = Added().emplace(metric.id, metric);
  if (is_new) return {};
  const std::string difference = FindDifference(known->second, metric);
  if (difference.empty()) return {};
  return Fail({}, "the metric '{}' has two different definitions: {}; Etude never mixes values of two definitions",
              metric.id, difference);
}

const std::map<std::string, MetricInfo, std::less<>>& AddedMetrics() { return Added(); }

const MetricInfo* FindMetric(std::string_view id) {
  if (const MetricInfo* ours = FindInCatalogue(id)) return ours;
  const auto added = Added().find(id);
  return added == Added().end() ? nullptr : &added->second;
}

}  // namespace etude
