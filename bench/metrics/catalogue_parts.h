#pragma once

#include <vector>

#include "bench/metrics/catalogue.h"

namespace etude {

/// The catalogue by domain; `AllMetrics` puts them together.
std::vector<MetricInfo> IkCatalogue();
std::vector<MetricInfo> CaptureCatalogue();
std::vector<MetricInfo> MaskCatalogue();
std::vector<MetricInfo> TransitionCatalogue();
std::vector<MetricInfo> DetectionCatalogue();

}  // namespace etude
