#pragma once

#include <string>

#include "engine/base/result.h"

namespace etude {

/// The path of a program, the way a shell finds it.
Result<std::string> FindProgram(const std::string& name);

}  // namespace etude
