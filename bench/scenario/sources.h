#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/keys/key_info.h"
#include "engine/document/node.h"

namespace etude {

/// Returns a file's text, or an error at `asked_at`, where its name stands.
using TextOf = std::function<Result<std::string>(const std::string& file, const Place& asked_at)>;

/// Returns the mappings of the scenarios of `file`, in order, with defaults inserted for keys that a scenario does not
/// have. A scenario's own keys win over the file's `defaults`, these over included ones, and a later include over an
/// earlier one. A key's value is replaced as a whole. Every node keeps its position in its file, for complaints.
Result<std::vector<Node>> CollectScenarios(const std::string& file, const TextOf& text_of);

/// Returns the keys at the top of a file of several scenarios.
std::span<const KeyInfo> FileKeys();

}  // namespace etude
