#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Writes every summary of one scenario as CSV: median, interval, mean, how many values there are, how many are missing
/// and why; first the share of cells that ended ok, failures in the denominator. Full precision, empty fields for
/// values that do not exist.
std::string NumberTableCsv(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
