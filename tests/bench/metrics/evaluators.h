#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "io/files/json.h"

namespace etude {

/// A metric's value; nothing if it has none.
using Value = std::optional<double>;

/// A metric's function from a test vector's input to its value. It calls the tasks' functions, and throws
/// Json::exception for input that does not fit.
struct Evaluator {
  std::string_view metric;
  Value (*value)(const Json& in);
};

/// Return the evaluators of each domain; `EvaluateMetric` searches all of them.
std::span<const Evaluator> IkEvaluators();  ///< also of task tracking
std::span<const Evaluator> CaptureEvaluators();
std::span<const Evaluator> TransitionEvaluators();  ///< also of the metrics of matching transition points
std::span<const Evaluator> PoseDistanceEvaluators();
std::span<const Evaluator> DetectionEvaluators();
std::span<const Evaluator> CoachEvaluators();
std::span<const Evaluator> EvaluationEvaluators();
std::span<const Evaluator> PlausibilityEvaluators();

}  // namespace etude
