#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "io/files/json.h"

namespace etude {

/// Nothing where the metric has no value.
using Value = std::optional<double>;

/// What computes a metric from the input of a test vector, by the functions that the tasks measure with; throws
/// Json::exception for what is no such input.
struct Evaluator {
  std::string_view metric;
  Value (*value)(const Json& in);
};

/// By domain; `EvaluateMetric` looks in all of them.
std::span<const Evaluator> IkEvaluators();  ///< tracking, too
std::span<const Evaluator> CaptureEvaluators();
std::span<const Evaluator> TransitionEvaluators();  ///< matching, too
std::span<const Evaluator> PoseDistanceEvaluators();
std::span<const Evaluator> DetectionEvaluators();
std::span<const Evaluator> CoachEvaluators();
std::span<const Evaluator> EvaluationEvaluators();
std::span<const Evaluator> PlausibilityEvaluators();

}  // namespace etude
