#pragma once

#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/model/run_data.h"

namespace etude {

/// Tells in lines of text on which systems two runs were computed, where these differ; by how much results were
/// measured to differ between them (on the quick suite, docs/guide/install.md); and which gated values of the two
/// snapshots, those of the runs, differ by more. Nothing where the systems are one.
std::vector<std::string> CompareSystems(const RunSystem& a, const RunSystem& b, const Snapshot& before,
                                        const Snapshot& after);

}  // namespace etude
