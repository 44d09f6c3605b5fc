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
  /// Its weights are paper A's here; learnt weights depend on the world.
  TransitionWay way = DefaultWay();
  WeightSource weights = WeightSource::kFixed;
  double wait_s = 1;  ///< the budget of its requests, seconds
};

/// A condition of a transition scenario.
struct TransitionCondition {
  double threshold = kPaperThreshold;  ///< for methods that set none
  double wait_s = 1;                   ///< for methods that set none
  bool explain = false;  ///< whether every cell keeps the explanation of its transition (ExplanationOf), not only
                         ///< recordings
  StageRules stage;      ///< without its fuzzy system
};

const FieldTable<TransitionCondition>& TransitionConditionFields();
const FieldTable<TransitionMethod>& TransitionMethodFields();

}  // namespace etude
