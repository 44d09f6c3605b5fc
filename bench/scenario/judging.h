#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// The metrics that a task's cells report.
std::vector<std::string> MetricsOf(const TaskKind& kind);

/// Those and the scenario's own.
std::vector<std::string> MetricsOf(const TaskKind& kind, const Scenario& scenario);

/// Adds a metric to a list of them. Complains of one that is not `known`, or stands there already.
void NoteMetric(Fields& fields, const std::string& task, const std::vector<std::string>& known, const std::string& name,
                const Place& place, std::vector<std::string>& metrics);

// The keys of `expect`, `gate` and its `time_ratios`: they name methods and conditions of `scenario`, which must
// outlive the tables, and `metrics` of its task.
FieldTable<Expectation> ExpectationFields(const Scenario& scenario, const std::vector<std::string>& metrics);
FieldTable<GateRules> GateFields(const Scenario& scenario, const std::vector<std::string>& metrics);
FieldTable<TailRule> TailFields();
FieldTable<TimeRatio> TimeRatioFields(const Scenario& scenario);

}  // namespace etude
