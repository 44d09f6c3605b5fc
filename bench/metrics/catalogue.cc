#include "bench/metrics/catalogue.h"

#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

std::vector<MetricInfo> PutTogether() {
  struct Part {
    const char* domain;
    std::vector<MetricInfo> metrics;
  };
  Part parts[] = {{"Inverse kinematics", IkCatalogue()},   {"Tracking", TrackingCatalogue()},
                  {"Camera capture", CaptureCatalogue()},  {"Person masks", MaskCatalogue()},
                  {"Transitions", TransitionCatalogue()},  {"Matching", MatchingCatalogue()},
                  {"Search", SearchCatalogue()},           {"Pose distances", PoseDistanceCatalogue()},
                  {"Move detection", DetectionCatalogue()}};
  std::vector<MetricInfo> all;
  for (Part& part : parts) {
    for (MetricInfo& metric : part.metrics) {
      metric.domain = part.domain;
      all.push_back(std::move(metric));
    }
  }
  return all;
}

const std::vector<MetricInfo>& Catalogue() {
  static const std::vector<MetricInfo> metrics = PutTogether();
  return metrics;
}

}  // namespace

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

std::span<const MetricInfo> AllMetrics() { return Catalogue(); }

const MetricInfo* FindMetric(std::string_view id) {
  for (const MetricInfo& metric : Catalogue()) {
    if (metric.id == id) return &metric;
  }
  return nullptr;
}

}  // namespace etude
