#pragma once

#include <string>
#include <vector>

#include "reports/transitions/recorded_requests.h"

namespace etude {

/// Why each recorded transition went where it went, the methods of one request side by side: the ways taken, the ten
/// partial distances of the frames that met, and the candidates. Long lists are cut, and say so. "" without worlds.
std::string TransitionsHtml(const std::vector<RecordedRequest>& worlds);

/// The same in short: the ways, and what the distances are made of.
std::string TransitionsMarkdown(const std::vector<RecordedRequest>& worlds);

/// "LF 0.051, RF 0.036, LHE 0.035": the largest of the partial distances, at most three; "all alike" when all are 0.
std::string MostlyBy(const PerFeature& partials);

}  // namespace etude
