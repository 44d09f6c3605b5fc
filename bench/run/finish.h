#pragma once

#include <filesystem>
#include <functional>

#include "bench/files/json.h"
#include "bench/run/journal.h"

namespace etude {

/// Writes the results of a whole run into its folder: cells, series, recordings, summary, timings and, last,
/// host.json. Then the journal, if any, is removed: without it a folder counts as finished. `cells` must be complete.
/// Many are summed up by `jobs` processes. `goes_on` is told how many rows are written, every few thousand; when it
/// says no, the folder stays unfinished. Gives whether it is finished.
Result<bool> FinishRun(const std::filesystem::path& folder, const Plan& plan, CellTable& cells, const Json& host,
                       int jobs, const std::function<bool(std::size_t rows)>& goes_on);

}  // namespace etude
