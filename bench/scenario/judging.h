#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// Returns the ids of the metrics that a task's cells report.
std::vector<std::string> MetricsOf(const TaskKind& kind);

/// Returns the ids of the task's metrics and of the metrics that the scenario defines itself.
std::vector<std::string> MetricsOf(const TaskKind& kind, const Scenario& scenario);

/// Returns the metrics that a scenario may name as `success`: shares and scores for which higher is better.
std::vector<std::string> SuccessMetricsOf(const TaskKind& kind, const Scenario& scenario);

/// Adds a metric to `metrics`. Adds an error to `fields` if the metric is not in `known`, or is already in the list.
void NoteMetric(Fields& fields, const std::string& task, const std::vector<std::string>& known, const std::string& name,
                const Place& place, std::vector<std::string>& metrics);

// These functions return the keys of `expect`, `gate` and `time_ratios`. The keys name methods and conditions of
// `scenario`, which must outlive the returned tables, and metrics of the scenario's task (`metrics`).
FieldTable<Expectation> ExpectationFields(const Scenario& scenario, const std::vector<std::string>& metrics);
// Returns the keys about success. The value of `success` must be one of `metrics`, the result of SuccessMetricsOf.
FieldTable<Scenario> SuccessFields(const std::vector<std::string>& metrics);
FieldTable<GateRules> GateFields(const Scenario& scenario, const std::vector<std::string>& metrics);
FieldTable<TailRule> TailFields();
FieldTable<TimeRatio> TimeRatioFields(const Scenario& scenario);

}  // namespace etude
