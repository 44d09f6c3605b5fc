#pragma once

#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/model/run_data.h"

namespace etude {

/// If the systems of two runs differ, returns lines that describe both, the differences of results that were measured
/// between such systems (quick suite, docs/guide/install.md), and the gated values of the snapshots that differ by
/// more. Empty if the systems are the same.
std::vector<std::string> CompareSystems(const RunSystem& a, const RunSystem& b, const Snapshot& before,
                                        const Snapshot& after);

}  // namespace etude
