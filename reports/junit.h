#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// The run as JUnit XML, for CI systems: a suite per scenario; in it a case per expectation (failed when
/// unmet, skipped when it could not be decided), one that holds when every cell has its row, and one that
/// holds when no cell crashed, failed, ran out of time or answered badly.
std::string WriteJunit(const RunData& run);

}  // namespace etude
