#pragma once

#include <string>
#include <vector>

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// These functions return the keys of a metric that an outside program measures (OutsideMetricFields), and the keys of
/// one of its test vectors (MetricExampleFields).
const FieldTable<OutsideMetric>& OutsideMetricFields();
const FieldTable<MetricExample>& MetricExampleFields();

/// Describes the values of the key `metrics`: names, and mappings of OutsideMetricFields.
ValueKind HeadlineKind();

/// Reads `metrics` and returns the headline metrics; if the file names none, these are the task's headline metrics.
/// Metrics that the scenario defines are also added to `own` and to the catalogue (AddMetric). Errors are collected in
/// `fields`.
std::vector<std::string> ReadHeadline(Fields& fields, const TaskKind& kind, std::vector<OutsideMetric>& own);

}  // namespace etude
