#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/bridging/splice.h"
#include "engine/bridging/transition.h"
#include "engine/document/fields.h"

namespace etude {

/// One way to switch: a choice of frames and a join.
///
///     - {name: fuzzy, choice: fuzzy-bridge, join: cut, weights: adaptive, threshold: 0.4, pick: first}
struct TransitionMethod {
  std::string name;
  Choice choice = Choice::kFuzzyBridge;
  Join join = Join::kCut;
  bool adaptive_weights = false;
  SwitchRules rules;  ///< its weights are paper A's; adaptive ones depend on the world
};

/// The keys of a method with what they may say.
std::vector<std::pair<std::string, std::string>> TransitionMethodKeys();

/// Reads the methods. `condition` may give `threshold` and `wait_s` for all of them, which is what
/// makes those two sweepable.
Result<std::vector<TransitionMethod>> ReadTransitionMethods(Fields& condition, std::span<const Node> methods);

}  // namespace etude
