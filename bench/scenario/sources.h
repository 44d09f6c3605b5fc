#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/keys/key_info.h"
#include "engine/document/node.h"

namespace etude {

/// Gives a file's text, or complains at `asked_at`: where its name stands.
using TextOf = std::function<Result<std::string>(const std::string& file, const Place& asked_at)>;

/// The mappings of the scenarios of `file`, in order, each with the defaults that it does not replace put in.
/// What a scenario says wins over `defaults` of its file, these over included ones, and a later include over
/// an earlier one. Keys are replaced whole; every node keeps the place where it stands.
Result<std::vector<Node>> CollectScenarios(const std::string& file, const TextOf& text_of);

/// The keys at the top of a file of several scenarios.
std::span<const KeyInfo> FileKeys();

}  // namespace etude
