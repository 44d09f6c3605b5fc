#include "tests/bench/metrics/evaluate.h"

#include <nlohmann/json.hpp>

#include "tests/bench/metrics/evaluators.h"

namespace etude {

Result<std::optional<double>> EvaluateMetric(std::string_view metric, std::string_view input_json) {
  for (const auto& evaluators :
       {IkEvaluators(), CaptureEvaluators(), TransitionEvaluators(), PoseDistanceEvaluators(),
        DetectionEvaluators(), CoachEvaluators(), EvaluationEvaluators(), PlausibilityEvaluators()}) {
    for (const Evaluator& evaluator : evaluators) {
      if (evaluator.metric != metric) continue;
      try {
        return evaluator.value(Json::parse(input_json));
      } catch (const Json::exception& error) {
        return Fail({}, "not an input of {}: {}", metric, error.what());
      }
    }
  }
  return Fail({}, "no function evaluates the metric '{}'", metric);
}

}  // namespace etude
