#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/ik/exchange.h"
#include "bench/tasks/ik/ik_options.h"
#include "bench/tasks/ik/ik_world.h"

namespace etude {

/// Runs one method in one world and scores it: metrics, digests, the curves of the first iterations, and the recording
/// ("truth", "start" and, iteration by iteration, "solution") when motion is kept.
CellResult RunIkCell(const KinematicTree& tree, const IkWorld& world, const IkMethod& method, bool keeps_motion);

/// Scores an answer of a method outside likewise; no curves, and a recording of two frames, start and answer. A broken
/// limit makes it unsolved. `max_steps` is the limit of its cost.
CellResult ScoreIkAnswer(const KinematicTree& tree, const IkWorld& world, const IkAnswer& answer, int max_steps,
                         bool keeps_motion);

/// What a cell without an answer is credited with (PAR-2): 0 for solved shares, twice the limit for penalised costs.
std::optional<double> IkValueOfFailure(std::string_view metric, int max_steps);

}  // namespace etude
