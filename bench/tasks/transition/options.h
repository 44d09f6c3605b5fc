#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/training/learnt_weights.h"
#include "engine/document/fields.h"
#include "engine/transitions/transition.h"

namespace etude {

/// One method, as a scenario names it.
///
///     - {name: fuzzy, choice: fuzzy-bridge, join: cut, weights: adaptive, threshold: 0.4, pick: first}
struct TransitionMethod {
  std::string name;
  TransitionWay way;  ///< its weights are paper A's; learnt ones depend on the world
  WeightSource weights = WeightSource::kFixed;
  double wait_s = 1;  ///< the budget of its requests
};

/// The keys of a scenario and of a method, for the reference page.
std::vector<KeyInfo> TransitionConditionKeys();
std::vector<KeyInfo> TransitionMethodKeys();

/// What a condition says for all methods, which is what makes these two sweepable.
struct CommonLimits {
  double threshold = kPaperThreshold;
  double wait_s = 1;
};
/// Complaints stay in `condition`.
CommonLimits ReadCommonLimits(Fields& condition);
/// Whether every cell keeps what explains its switch (ExplanationOf); else only recordings do.
bool ReadExplain(Fields& condition);

Result<std::vector<TransitionMethod>> ReadTransitionMethods(const CommonLimits& common, std::span<const Node> methods);

}  // namespace etude
