#pragma once

#include <span>

#include "bench/run/setup.h"
#include "engine/base/result.h"
#include "io/process/fence.h"

namespace etude {

/// Tries what the cells of these scenarios will need of this machine, so that a fault of it is told before anything is
/// written: processes, the renderer, and for methods outside their programs, a folder for temporary files and the
/// fence. Fails with an error of this machine.
Result<void> TryMachine(std::span<const PreparedScenario> scenarios, const Fence& fence);

/// Fails when the scenario's worlds are to be drawn and nothing can be drawn in this process. What is made for that is
/// what its worlds then use.
Result<void> TryRenderer(const PreparedScenario& scenario);

}  // namespace etude
