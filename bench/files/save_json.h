#pragma once

#include <filesystem>

#include "bench/files/json.h"

namespace etude {

/// Writes one JSON value and a line end, whole or not at all.
Result<void> SaveJson(const std::filesystem::path& path, const Json& json);

}  // namespace etude
