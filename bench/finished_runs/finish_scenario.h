#pragma once

#include <span>
#include <string>

#include "bench/gate/finished_run.h"
#include "bench/run/setup.h"
#include "bench/scenario/scenario.h"

namespace etude {

/// What a gate must know of a scenario that has been run. `clip_digests`: of the clips it had loaded, in order. What
/// worlds are digests of leaves out all that does not shape them (questions, expectations, gate rules, comments), so
/// that editing those keeps a baseline valid.
FinishedScenario FinishScenario(const Scenario& scenario, const ScenarioSetup& setup,
                                std::span<const std::string> clip_digests);

}  // namespace etude
