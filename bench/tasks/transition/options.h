#pragma once

#include <string>

#include "bench/keys/field_table.h"
#include "bench/tasks/transition/stage.h"
#include "bench/training/learnt_weights.h"
#include "engine/transitions/choices/choice.h"

namespace etude {

/// Returns paper A's choice and join.
TransitionWay DefaultWay();

/// One method, as a scenario names it.
///
///     - {name: fuzzy, choice: fuzzy-bridge, join: cut, weights: adaptive, threshold: 0.4, pick: first}
struct TransitionMethod {
  std::string name;
  /// The weights in it are paper A's, because learnt weights depend on the world.
  TransitionWay way = DefaultWay();
  WeightSource weights = WeightSource::kFixed;
  double wait_s = 1;  ///< the budget of its requests, seconds
};

/// A condition of a transition scenario.
struct TransitionCondition {
  double threshold = kPaperThreshold;  ///< for methods that set none
  double wait_s = 1;                   ///< for methods that set none
  /// If true, every cell keeps the explanation of its transition (ExplanationOf); if false, only recordings do.
  bool explain = false;
  StageRules stage;  ///< its fuzzy system is not set here
};

const FieldTable<TransitionCondition>& TransitionConditionFields();
const FieldTable<TransitionMethod>& TransitionMethodFields();

}  // namespace etude
