#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/exchange.h"
#include "bench/tasks/ik/options.h"
#include "bench/tasks/ik/world.h"

namespace etude {

/// Runs one method in one world and scores it: metrics, digests, the curves of the first iterations and what else
/// `records` asks for. A world is solved when its effectors meet what it asks of them and no limit is broken; the
/// reason of any other cell says why it stopped.
CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, const IkRecords& records);

/// Scores an answer of a method outside likewise; no curves, and a recording of two frames, start and answer.
/// `max_steps` is the limit of its cost.
CellResult ScoreIkAnswer(const KinematicTree& tree, const IkWorld& world, const IkAnswer& answer, int max_steps,
                         const IkRecords& records);

/// What a cell without an answer is credited with (PAR-2): 0 for solved shares, twice the limit for penalised costs.
std::optional<double> IkValueOfFailure(std::string_view metric, int max_steps);

}  // namespace etude
