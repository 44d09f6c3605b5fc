#pragma once

#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/model/run_data.h"

namespace etude {

/// Returns lines about two runs on different systems. They name both systems; state how much the results of the quick
/// suite differed when such systems were compared (docs/guide/install.md); and list the metrics whose values differ
/// more than that between `before` and `after`. If one of the systems has not been measured, a line says so instead.
/// Returns no lines if the systems are the same.
std::vector<std::string> CompareSystems(const RunSystem& a, const RunSystem& b, const Snapshot& before,
                                        const Snapshot& after);

}  // namespace etude
