#pragma once

#include <string>
#include <vector>

#include "bench/scenario/scenario.h"
#include "engine/document/fields.h"

namespace etude {

/// The keys of a metric that another program measures, and of one of its test vectors.
const FieldTable<OutsideMetric>& OutsideMetricFields();
const FieldTable<MetricExample>& MetricExampleFields();

/// Describes the values of `metrics`: names, and mappings of OutsideMetricFields.
ValueKind HeadlineKind();

/// Reads `metrics`: the headline metrics, or the task's if the file names none of them. Metrics that the scenario
/// defines are also added to `own` and to the catalogue (AddMetric). Complaints stay in `fields`.
std::vector<std::string> ReadHeadline(Fields& fields, const TaskKind& kind, std::vector<OutsideMetric>& own);

}  // namespace etude
