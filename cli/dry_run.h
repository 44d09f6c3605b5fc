#pragma once

#include "bench/run/run.h"

namespace etude {

/// Prints what a run would compute, how long it would take and which differences it could show, as text or as JSON.
/// Returns the exit code.
int DryRunCommand(const RunOptions& options, bool as_json);

}  // namespace etude
