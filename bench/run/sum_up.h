#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/statistics/summary.h"
#include "engine/base/result.h"

namespace etude {

/// Gives what `work` returns for 0 … count − 1, in that order, each from one of `jobs` copies of this process, which
/// see all that it holds and change nothing of it. Fails with the first complaint, or when a copy dies.
Result<std::vector<std::string>> RunForked(std::size_t count, int jobs,
                                           const std::function<Result<std::string>(std::size_t)>& work);

/// Summarise, of many rows with conditions shared out among `jobs` processes; the same summary for any number of them.
Result<ScenarioSummary> SumUp(const Study& study, const ScenarioTable& table, std::uint64_t seed, int jobs);

}  // namespace etude
