#pragma once

#include <span>

#include "bench/run/setup.h"
#include "engine/base/result.h"
#include "io/process/fence.h"

namespace etude {

/// Tries everything that these scenarios need from the machine: processes, the renderer and, for outside programs,
/// their executables, temporary files and the sandbox (fence). A fault of this machine is thus reported before anything
/// is written.
Result<void> TryMachine(std::span<const PreparedScenario> scenarios, const Fence& fence);

/// Makes the renderer of this process if the scenario's worlds need rendering. Fails if this machine cannot render.
Result<void> TryRenderer(const PreparedScenario& scenario);

}  // namespace etude
