#pragma once

#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/capture_options.h"
#include "bench/tasks/capture/capture_world.h"
#include "bench/tasks/capture/film.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Runs one method on what was filmed and measures it. `observation` is the take's for this method's way
/// of cutting out the person.
CellResult RunCaptureCell(const CaptureWorld& world, const Take& take, const Observation& observation,
                          const StudioOptions& options, const CaptureMethod& method, bool wants_recording);

/// How the method cuts out the person.
PersonSource PersonSourceOf(const CaptureMethod& method);

}  // namespace etude
