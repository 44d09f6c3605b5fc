#pragma once

#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/model/run_data.h"

namespace etude {

/// If two runs were made on different systems, returns lines that describe both systems, the differences of results
/// that were measured between such systems (quick suite, docs/guide/install.md), and the gated values that differ by
/// more than that between the snapshots. Empty if the systems are the same.
std::vector<std::string> CompareSystems(const RunSystem& a, const RunSystem& b, const Snapshot& before,
                                        const Snapshot& after);

}  // namespace etude
