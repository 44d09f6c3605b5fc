#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

// Each reads one key of a scenario whose methods and conditions are known, and leaves complaints in `fields`.

/// `metrics`: the headline metrics; the task's own when the file names none.
std::vector<std::string> ReadMetrics(Fields& fields, const TaskKind& kind);

/// `expect`: what should come out.
std::vector<Expectation> ReadExpectations(Fields& fields, const Scenario& scenario, const TaskKind& kind);

/// `gate`: what is held against a baseline; the headline metrics when the file names none.
GateRules ReadGate(Fields& fields, const Scenario& scenario, const TaskKind& kind);

}  // namespace etude
