#pragma once

#include "bench/model/run_data.h"

namespace etude {

/// Returns ExampleRun with both verdicts and with rivals, as current runs have them. Each world of ik is a sampling
/// unit; capture's worlds come from 4 clips (too few for a verdict on other clips), detection's from 6 and
/// transition's from 8 clips.
RunData UnitRun();

/// Adds rivals and verdicts on other sampling units to a scenario, as UnitRun does. Its worlds then come from `clips`
/// clips, unless worlds are the units.
void AddUnits(RunData& run, ScenarioSummary& scenario, int clips);

}  // namespace etude
