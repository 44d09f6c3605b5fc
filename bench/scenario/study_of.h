#pragma once

#include "bench/model/study.h"
#include "bench/scenario/scenario.h"

namespace etude {

/// Returns the part of a scenario that is needed to judge the scenario's rows.
Study StudyOf(const Scenario& scenario);

}  // namespace etude
