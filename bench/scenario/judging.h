#pragma once

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// Returns the metrics that a task's cells report.
std::vector<std::string> MetricsOf(const TaskKind& kind);

/// Returns the task's metrics and those that the scenario defines itself.
std::vector<std::string> MetricsOf(const TaskKind& kind, const Scenario& scenario);

/// Returns those of these metrics that may be a scenario's success: shares and scores for which higher is better.
std::vector<std::string> SuccessMetricsOf(const TaskKind& kind, const Scenario& scenario);

/// Adds a metric to `metrics`. Complains if it is not in `known` or already in the list.
void NoteMetric(Fields& fields, const std::string& task, const std::vector<std::string>& known, const std::string& name,
                const Place& place, std::vector<std::string>& metrics);

// The keys of `expect`, `gate` and its `time_ratios`. They name methods and conditions of `scenario`, which must
// outlive the tables, and `metrics` of its task.
FieldTable<Expectation> ExpectationFields(const Scenario& scenario, const std::vector<std::string>& metrics);
// The keys about success; `success` must be one of `metrics`, which SuccessMetricsOf returns.
FieldTable<Scenario> SuccessFields(const std::vector<std::string>& metrics);
FieldTable<GateRules> GateFields(const Scenario& scenario, const std::vector<std::string>& metrics);
FieldTable<TailRule> TailFields();
FieldTable<TimeRatio> TimeRatioFields(const Scenario& scenario);

}  // namespace etude
