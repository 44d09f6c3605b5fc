#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/embedded_text.h"
#include "engine/base/result.h"
#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"

namespace etude {

/// A rule such as "if RH is up and LH is up, the pose is 'arms up'".
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

/// Infers poses as Mamdani does: a rule holds as far as the weakest term of its premise does, a pose as far as the
/// strongest rule that concludes it. One activation in [0, 1] per pose.
std::vector<double> InferPoses(const RuleBase& base, const Grades& grades);

/// The pose of largest activation, the earlier one on a tie; null when no rule holds at all.
const std::string* ChoosePose(const RuleBase& base, const Grades& grades);

/// The parts of paper A's fuzzy system that a file (docs/fuzzy-system.md) can replace; paper A's own by default.
struct FuzzySystem {
  std::string name = "paper";
  Memberships memberships = PaperMemberships();
  FeatureWeights weights = PaperWeights();  ///< S of equation 1, the `fixed` ones; they sum to 8
  RuleBase rules = PaperRules();
};

/// Reads a system from the text of a YAML file; `file` is what complaints call it. All features and terms of table 1
/// must be there, and no other. Weights are relative: they are scaled to sum to 8, so that thresholds keep their
/// meaning.
Result<FuzzySystem> ReadFuzzySystem(std::string_view text, const std::string& file);
/// The text that ReadFuzzySystem reads back to the same system, to the last bit.
std::string WriteFuzzySystem(const FuzzySystem& system);

/// Returns the files scenarios/fuzzy/*.yaml, sorted by name (written by the build).
std::span<const EmbeddedText> BuiltinFuzzySystemFiles();
/// Lists "gaussian", "paper": what `builtin:NAME` may name.
std::vector<std::string> BuiltinFuzzySystemNames();
/// One of them, by its name without "builtin:"; `place` is where it is asked for.
Result<FuzzySystem> LoadBuiltinFuzzySystem(const std::string& name, const Place& place);

}  // namespace etude
