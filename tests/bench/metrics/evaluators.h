#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "io/files/json.h"

namespace etude {

/// The value of a metric; nothing if it has none.
using Value = std::optional<double>;

/// A metric's function from the input of a test vector to its value. It uses the functions that the tasks use, and
/// throws Json::exception for input that does not fit.
struct Evaluator {
  std::string_view metric;
  Value (*value)(const Json& in);
};

/// Return the evaluators of each domain; `EvaluateMetric` searches all of them.
std::span<const Evaluator> IkEvaluators();  ///< also for tracking
std::span<const Evaluator> CaptureEvaluators();
std::span<const Evaluator> TransitionEvaluators();  ///< also for matching
std::span<const Evaluator> PoseDistanceEvaluators();
std::span<const Evaluator> DetectionEvaluators();
std::span<const Evaluator> CoachEvaluators();
std::span<const Evaluator> EvaluationEvaluators();
std::span<const Evaluator> PlausibilityEvaluators();

}  // namespace etude
