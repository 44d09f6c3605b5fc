#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// The metrics that a task's cells report.
std::vector<std::string> MetricsOf(const TaskKind& kind);

/// Reads `metrics`: the headline metrics; the task's own when the file names none. Complaints stay in `fields`.
std::vector<std::string> ReadMetrics(Fields& fields, const TaskKind& kind);

// The keys of `expect`, `gate` and its `time_ratios`: they name methods and conditions of `scenario`, which must
// outlive the tables, and `metrics` of its task.
FieldTable<Expectation> ExpectationFields(const Scenario& scenario, const std::vector<std::string>& metrics);
FieldTable<GateRules> GateFields(const Scenario& scenario, const std::vector<std::string>& metrics);
FieldTable<TailRule> TailFields();
FieldTable<TimeRatio> TimeRatioFields(const Scenario& scenario);

}  // namespace etude
