#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "bench/files/json.h"

namespace etude {

/// Nothing where the metric has no value.
using EvaluatedMetric = std::optional<double>;

/// What computes a metric from the input of a test vector; throws Json::exception for what is none.
struct Evaluator {
  std::string_view metric;
  EvaluatedMetric (*value)(const Json& in);
};

/// Of everything about changing clips: transitions, matching, search, distances of poses.
std::span<const Evaluator> TransitionEvaluators();

}  // namespace etude
