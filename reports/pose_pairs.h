#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Of a scenario of the task `pose-distance` whose worlds are single named pairs of poses: pair by pair how far the
/// poses are apart, and what each method says. "" for any other.
std::string PosePairsHtml(const RunData& run, const ScenarioSummary& scenario);
std::string PosePairsMarkdown(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
