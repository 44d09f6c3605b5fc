#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/embedded_text.h"
#include "engine/base/result.h"
#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"
#include "engine/fuzzy/rules.h"

namespace etude {

/// What can be swapped and tuned in paper A's fuzzy system: a file (docs/fuzzy-system.md). Paper A's own by default.
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

/// scenarios/fuzzy/*.yaml, sorted by name (written by the build).
std::span<const EmbeddedText> BuiltinFuzzySystemFiles();
/// "gaussian", "paper": what `builtin:NAME` may name.
std::vector<std::string> BuiltinFuzzySystemNames();
/// One of them, by its name without "builtin:"; `place` is where it is asked for.
Result<FuzzySystem> LoadBuiltinFuzzySystem(const std::string& name, const Place& place);

}  // namespace etude
