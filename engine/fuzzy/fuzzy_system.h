#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"

namespace etude {

/// What can be swapped and tuned in paper A's fuzzy system: a file (docs/bridging.md).
struct FuzzySystem {
  std::string name = "paper";
  Memberships memberships = PaperMemberships();
  FeatureWeights weights = PaperWeights();  ///< S of equation 1, the `fixed` ones
};

/// Reads a system from the text of a YAML file; `file` is what complaints call it.
Result<FuzzySystem> ReadFuzzySystem(const std::string& text, const std::string& file);
/// The text that ReadFuzzySystem reads back to the same system.
std::string WriteFuzzySystem(const FuzzySystem& system);

}  // namespace etude
