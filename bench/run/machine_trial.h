#pragma once

#include <span>

#include "bench/run/setup.h"
#include "engine/base/result.h"
#include "io/process/fence.h"

namespace etude {

/// Tries what these scenarios need, so that a fault of this machine is reported before anything is written: processes,
/// the renderer and, for outside methods, their programs, temporary files and the fence.
Result<void> TryMachine(std::span<const PreparedScenario> scenarios, const Fence& fence);

/// Makes the renderer of this process if the scenario's worlds are drawn. Fails if nothing can be drawn.
Result<void> TryRenderer(const PreparedScenario& scenario);

}  // namespace etude
