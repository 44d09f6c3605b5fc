#pragma once

#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"

namespace etude {

/// The catalogue by domain; `AllMetrics` puts them together.
std::vector<MetricInfo> IkCatalogue();
std::vector<MetricInfo> TrackingCatalogue();
std::vector<MetricInfo> CaptureCatalogue();
std::vector<MetricInfo> MaskCatalogue();
std::vector<MetricInfo> TransitionCatalogue();
std::vector<MetricInfo> MatchingCatalogue();
std::vector<MetricInfo> SearchCatalogue();
std::vector<MetricInfo> PoseDistanceCatalogue();
std::vector<MetricInfo> DetectionCatalogue();

/// Ends the null rule of a metric that only a built-in method's stages can tell.
inline const std::string kOutside = ", or the method is one outside, whose stages are not seen.";

}  // namespace etude
