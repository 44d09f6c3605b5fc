#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

/// The prefix of the name of a built-in fuzzy system.
constexpr std::string_view kBuiltinFuzzySystem = "builtin:";

/// Reads the text of a file.
using FuzzyTextOf = std::function<Result<std::string>(const std::string& file)>;

/// Opens the fuzzy system that `reference` names: `builtin:NAME`, or a file, whose text `text_of` reads. `asked_at` is
/// the position of the reference, for error messages.
Result<FuzzySystem> OpenFuzzySystem(const std::string& reference, const Place& asked_at, const FuzzyTextOf& text_of);

}  // namespace etude
