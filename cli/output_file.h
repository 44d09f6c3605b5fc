#pragma once

#include <cstdio>
#include <string>

#include "engine/base/result.h"

namespace etude {

/// Refuses to write over what is there already.
Result<void> CheckOutput(const std::string& path, bool overwrite);

/// Says that a file is there now: on standard output, unless that is for programs.
void TellWritten(const std::string& path, std::FILE* stream = stdout);

}  // namespace etude
