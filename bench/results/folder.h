#pragma once

#include <filesystem>

#include "bench/results/run_data.h"

namespace etude {

/// Reads a result folder (design.md §4). Fails with file:line when a file is missing, torn or of
/// another schema version.
Result<RunData> LoadRun(const std::filesystem::path& folder);

}  // namespace etude
