#pragma once

#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/model/run_data.h"

namespace etude {

/// Returns lines of text that say on which systems two runs were computed, if these differ; by how much results were
/// measured to differ between them (on the quick suite, docs/guide/install.md); and which gated values of the runs'
/// snapshots differ by more. Empty if the systems are the same.
std::vector<std::string> CompareSystems(const RunSystem& a, const RunSystem& b, const Snapshot& before,
                                        const Snapshot& after);

}  // namespace etude
