#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Fails if a path does not end in `ending` (such as ".png"), if it names a folder or a device, or, without
/// `overwrite`, an existing file. The path "" (no output) is fine.
Result<void> CheckOutput(const std::string& path, bool overwrite, std::string_view ending = "");

/// Prints to `stream` that a file was written. Pass `stderr` if standard output must contain only JSON.
void TellWritten(const std::string& path, std::FILE* stream = stdout);

}  // namespace etude
