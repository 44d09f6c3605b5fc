#pragma once

#include <string>

#include "bench/keys/field_table.h"
#include "bench/tasks/transition/stage.h"
#include "bench/training/learnt_weights.h"
#include "engine/transitions/choices/choice.h"

namespace etude {

/// Returns the choice and the join of paper A.
TransitionWay DefaultWay();

/// One method of a transition scenario, for example:
///
///     - {name: fuzzy, choice: fuzzy-bridge, join: cut, weights: adaptive, threshold: 0.4, pick: first}
struct TransitionMethod {
  std::string name;
  /// The choice and the join. The weights in `way` are paper A's, because learnt weights depend on the world.
  TransitionWay way = DefaultWay();
  WeightSource weights = WeightSource::kFixed;
  double wait_s = 1;  ///< the longest wait of the method's requests, seconds
};

struct TransitionCondition {
  double threshold = kPaperThreshold;  ///< threshold of methods that do not set their own
  double wait_s = 1;                   ///< longest wait, seconds, of methods that do not set their own
  /// True if every cell keeps the explanation of its transition (ExplanationOf); false if only recordings keep it.
  bool explain = false;
  StageRules stage;  ///< the rules of the stage; `fuzzy` comes from FuzzySystemOf
};

const FieldTable<TransitionCondition>& TransitionConditionFields();
const FieldTable<TransitionMethod>& TransitionMethodFields();

}  // namespace etude
