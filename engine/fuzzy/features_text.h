#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/document/node.h"
#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"

namespace etude {

/// What a file says about table 1's features.
struct FeatureSettings {
  Memberships memberships;
  FeatureWeights weights{};  ///< scaled to sum to 8
};

/// Reads the mapping under `features`: all ten of table 1 with all their terms, no other; "RH, LH" stand together.
Result<FeatureSettings> ReadFeatures(const Node& node);

/// Its lines, indented under `features`; features that are alike stand together.
std::string WriteFeatures(const FeatureSettings& settings);

}  // namespace etude
