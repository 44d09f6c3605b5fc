#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/keys/key_info.h"
#include "engine/document/node.h"

namespace etude {

/// Returns the text of a file. `asked_at` is the place where the file is named; errors state this place.
using TextOf = std::function<Result<std::string>(const std::string& file, const Place& asked_at)>;

/// Returns the mappings of the scenarios of `file`, in order. Defaults are inserted for keys that a scenario does not
/// have. A scenario's own keys replace keys of the file's `defaults`. The file's `defaults` replace defaults of
/// included files, and a later include replaces an earlier one. A key's value is replaced as a whole. Every node keeps
/// its place in its file, for error messages.
Result<std::vector<Node>> CollectScenarios(const std::string& file, const TextOf& text_of);

/// Returns the keys at the top level of a file that contains several scenarios.
std::span<const KeyInfo> FileKeys();

}  // namespace etude
