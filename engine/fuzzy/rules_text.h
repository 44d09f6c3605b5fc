#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/document/node.h"
#include "engine/fuzzy/rules.h"

namespace etude {

/// Reads the list under `rules`: `- {if: {RH: up, LH: up}, then: arms up}`. At most 100 rules.
Result<RuleBase> ReadRules(const Node& node);

/// Its lines, indented under `rules`.
std::string WriteRules(const RuleBase& base);

}  // namespace etude
