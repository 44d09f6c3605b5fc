#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Returns true if the scenario compares pairs of motion files.
bool ShowsPairs(const ScenarioSummary& scenario);

/// Returns, for each pair of files, the error in every frame as curves and, if the motions were recorded, the worst
/// frames as pictures. The pair with the largest error comes first. Returns "" for other scenarios.
std::string PairsHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
