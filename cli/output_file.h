#pragma once

#include <cstdio>
#include <string>

#include "engine/base/result.h"

namespace etude {

/// Refuses a path that names a folder or a device, and without `overwrite` one at which there is a file already.
Result<void> CheckOutput(const std::string& path, bool overwrite);

/// Says that a file was written: on standard output, unless that is for programs.
void TellWritten(const std::string& path, std::FILE* stream = stdout);

}  // namespace etude
