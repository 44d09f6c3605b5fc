#pragma once

#include <string>
#include <vector>

#include "engine/fuzzy/membership.h"

namespace etude {

/// "If RH is up and LH is up, the pose is 'arms up'."
struct Rule {
  std::vector<std::size_t> terms;  ///< of the premise, as places in `AllTerms`; at least one
  std::size_t pose = 0;            ///< of the conclusion, as a place in RuleBase::poses
};

/// A fuzzy system's rules. Several may conclude the same pose.
struct RuleBase {
  std::vector<std::string> poses;  ///< unique, in the order in which rules first name them
  std::vector<Rule> rules;
};

/// The rules of scenarios/fuzzy/paper.yaml.
const RuleBase& PaperRules();

/// Mamdani's inference: a rule holds as far as the weakest term of its premise does, a pose as far as the strongest
/// rule that concludes it. One activation in [0, 1] per pose.
std::vector<double> InferPoses(const RuleBase& base, const Grades& grades);

/// The pose of largest activation, the earlier one on a tie; null when no rule holds at all.
const std::string* ChoosePose(const RuleBase& base, const Grades& grades);

}  // namespace etude
