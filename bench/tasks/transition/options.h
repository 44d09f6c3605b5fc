#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task.h"
#include "engine/bridging/splice.h"
#include "engine/bridging/transition.h"
#include "engine/document/fields.h"

namespace etude {

/// "cut", "inertialised".
std::vector<std::string> JoinNames();
/// `name` must be one of JoinNames().
Join JoinOf(std::string_view name);

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

/// The keys of a scenario and of a method, for the reference page.
std::vector<KeyInfo> TransitionConditionKeys();
std::vector<KeyInfo> TransitionMethodKeys();

/// What a condition says for all methods: `threshold` and `wait_s`, which is what makes those two sweepable.
/// Complaints stay in `condition`.
SwitchRules ReadCommonRules(Fields& condition);

Result<std::vector<TransitionMethod>> ReadTransitionMethods(const SwitchRules& common, std::span<const Node> methods);

}  // namespace etude
