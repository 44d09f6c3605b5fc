#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/statistics/summary.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"

namespace etude {

/// Returns the results of `work` for the numbers 0 … count − 1, in this order. `jobs` forked copies of this process
/// compute them. The copies see the memory of this process but cannot change it. Fails with the first error of `work`,
/// or if a copy dies. `on_progress` receives the number of finished results.
Result<std::vector<std::string>> RunForked(std::size_t count, int jobs,
                                           const std::function<Result<std::string>(std::size_t)>& work,
                                           const OnProgress& on_progress = {});

/// Returns the same summary as Summarise. If there are many rows, `jobs` processes share the work, one pair of
/// condition and method at a time; the summary does not depend on `jobs`. `on_progress` receives the number of finished
/// pairs.
Result<ScenarioSummary> SummariseInParallel(const Study& study, const ScenarioTable& table, std::uint64_t seed,
                                            int jobs, const OnProgress& on_progress = {});

}  // namespace etude
