#pragma once

#include <filesystem>

#include "engine/base/result.h"

namespace etude {

/// Returns once what a file holds is on its disk, so that a power cut cannot take it. Fails naming the file.
Result<void> SyncFile(const std::filesystem::path& path);

/// The same for a folder's own entries: which names it holds. A new file's name is only safe after this.
Result<void> SyncFolder(const std::filesystem::path& folder);

/// That a folder is there at all: the entries of the folders above it, as far as they may be opened.
Result<void> SyncPathTo(const std::filesystem::path& folder);

/// Every file below the folder, every folder, and the folder itself.
Result<void> SyncTree(const std::filesystem::path& folder);

}  // namespace etude
