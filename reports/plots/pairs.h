#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Returns true if the scenario compares pairs of motion files.
bool ShowsPairs(const ScenarioSummary& scenario);

/// Returns a section for each pair of files: the error over frames as curves and, if the motions were recorded, the
/// frames with the largest errors as pictures. The pair with the largest error comes first. Returns "" if
/// ShowsPairs is false.
std::string PairsHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
