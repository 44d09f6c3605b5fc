#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/ik_options.h"
#include "bench/tasks/ik/ik_world.h"

namespace etude {

/// Runs one method in one world and scores it: metrics, digests, the curves of the first iterations, and the recording
/// ("truth", "start" and, iteration by iteration, "solution") when wanted.
CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, bool wants_recording);

}  // namespace etude
