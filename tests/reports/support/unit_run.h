#pragma once

#include "bench/model/run_data.h"

namespace etude {

/// ExampleRun with both verdicts and rivals, as a run of today has them: ik's worlds are their own units, capture's come
/// from 4 clips (too few for a verdict beyond them), detection's from 6 and transition's from 8 clips.
RunData UnitRun();

/// Gives the scenario both, in the same way, its clips being so many.
void AddUnits(RunData& run, ScenarioSummary& scenario, int clips);

}  // namespace etude
