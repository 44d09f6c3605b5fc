#pragma once

#include "bench/model/run_data.h"

namespace etude {

/// Returns ExampleRun with both verdicts and with rivals, as current runs have them. Each world of ik is a sampling
/// unit; capture's worlds come from 4 clips (too few for a verdict on other clips), detection's from 6 and
/// transition's from 8 clips.
RunData UnitRun();

/// Adds both verdicts to a scenario as UnitRun does; its worlds then come from `clips` clips.
void AddUnits(RunData& run, ScenarioSummary& scenario, int clips);

}  // namespace etude
