#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The settings under which the same build gives the same bytes on any machine, as NAME=VALUE. They must stand before a
/// process starts, which is why work is done in child processes.
const std::vector<std::string>& PinnedEnvironment();

/// Starts this very command anew in the pinned environment, unless it is in there already. Returns only when it is, or
/// when that fails.
Result<void> EnterPinnedEnvironment();

}  // namespace etude
