#pragma once

#include <filesystem>

#include "bench/gate/finished_run.h"
#include "bench/results/folder.h"

namespace etude {

/// Reads a result folder with its scenarios and times. A run that is under way or was interrupted has no data,
/// only the reason. Fails like LoadRun, and when cells.jsonl holds a row twice or one that the manifest has not.
Result<FinishedRun> LoadFinishedRun(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired);

}  // namespace etude
