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
  std::vector<std::size_t> terms;  ///< terms of the premise, as indices in `AllTerms`; at least one
  std::size_t pose = 0;            ///< the conclusion, as an index in RuleBase::poses
};

/// The rules of a fuzzy system. Several rules may conclude the same pose.
struct RuleBase {
  std::vector<std::string> poses;  ///< names of the poses, unique, in the order of their first use by a rule
  std::vector<Rule> rules;
};

/// Returns the rules of scenarios/fuzzy/paper.yaml.
const RuleBase& PaperRules();

/// Infers poses by Mamdani's method: the activation of a rule is the smallest grade in its premise, and the activation
/// of a pose is the largest of the rules that conclude it. Returns one activation in [0, 1] per pose.
std::vector<double> InferPoses(const RuleBase& base, const Grades& grades);

/// Returns the pose of largest activation, the earlier one on a tie; null if every activation is 0.
const std::string* ChoosePose(const RuleBase& base, const Grades& grades);

/// The parts of paper A's fuzzy system that a file (docs/fuzzy-system.md) can replace. The defaults are paper A's.
struct FuzzySystem {
  std::string name = "paper";
  Memberships memberships = PaperMemberships();
  FeatureWeights weights = PaperWeights();  ///< the weights S of equation 1; they sum to 8
  RuleBase rules = PaperRules();
};

/// Reads a system from the text of a YAML file; error messages name it `file`. The file must hold all features and
/// terms of paper A's table 1 and no others. Weights are relative: they are scaled to sum to 8.
Result<FuzzySystem> ReadFuzzySystem(std::string_view text, const std::string& file);
/// Returns the text from which ReadFuzzySystem reads the same system, bit for bit.
std::string WriteFuzzySystem(const FuzzySystem& system);

/// Returns the files scenarios/fuzzy/*.yaml, sorted by name (embedded by the build).
std::span<const EmbeddedText> BuiltinFuzzySystemFiles();
/// Returns "gaussian" and "paper", the names allowed after `builtin:`.
std::vector<std::string> BuiltinFuzzySystemNames();
/// Loads the built-in system called `name`, without "builtin:"; `place` is the position of the name, for error
/// messages.
Result<FuzzySystem> LoadBuiltinFuzzySystem(const std::string& name, const Place& place);

}  // namespace etude
