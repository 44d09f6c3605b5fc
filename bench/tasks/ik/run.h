#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/options.h"
#include "bench/tasks/ik/world.h"

namespace etude {

/// Runs one method in one world and scores it: metrics, digests, the curves of the first iterations and what else
/// `records` asks for. The reason of a cell that is not solved says why the solver stopped.
CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, const IkRecords& records);

}  // namespace etude
