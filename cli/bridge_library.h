#pragma once

#include "cli/bridge_command.h"
#include "engine/base/result.h"
#include "reports/clips/bridge_summary.h"

namespace etude {

/// Opens and tags the clips of `options`, those of `to` among them.
Result<BridgeLibrary> LoadBridgeLibrary(const BridgeCommandOptions& options);

}  // namespace etude
