#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/search/run.h"

namespace etude {

/// Measures an answer, whoever gave it: `ok` when every query is answered right, else `unsolved` with how many are not
/// and the first of them. Series along the queries: how many frames were found and, where it is told, looked at.
CellResult ScoreSearch(const SearchLibrary& library, std::span<const Grades> queries, const SearchAnswer& answer,
                       const std::vector<FoundFrames>& truth);

/// The ids of all metrics that a cell reports, a value or a reason for each.
std::vector<std::string> SearchMetrics();

/// What a cell without an answer is credited with: no right answer.
std::optional<double> SearchFailureValue(std::string_view metric);

}  // namespace etude
