#pragma once

#include <cstdio>
#include <string>

#include "engine/base/result.h"

namespace etude {

/// Fails if a path names a folder or a device, or, without `overwrite`, an existing file.
Result<void> CheckOutput(const std::string& path, bool overwrite);

/// Prints to `stream` that a file was written. Pass `stderr` if standard output must contain only JSON.
void TellWritten(const std::string& path, std::FILE* stream = stdout);

}  // namespace etude
