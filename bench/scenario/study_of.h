#pragma once

#include "bench/model/study.h"
#include "bench/scenario/scenario.h"

namespace etude {

/// What judging a scenario's rows takes of it.
Study StudyOf(const Scenario& scenario);

}  // namespace etude
