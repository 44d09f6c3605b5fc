#pragma once

#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/model/run_data.h"

namespace etude {

/// Returns lines about two runs on different systems: a description of both systems, the differences of results that
/// were measured between such systems (quick suite, docs/guide/install.md), and the gated values whose differences are
/// larger. Returns no lines if the systems are the same.
std::vector<std::string> CompareSystems(const RunSystem& a, const RunSystem& b, const Snapshot& before,
                                        const Snapshot& after);

}  // namespace etude
