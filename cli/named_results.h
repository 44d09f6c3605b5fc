#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A method and the patterns of its answers.
struct NamedResult {
  std::string name;
  std::vector<std::string> patterns;
};

/// Reads RESULT or NAME=PATTERN, one for each method; one without a name is named after its folder or file. Fails if
/// several have no names: a shell may have put files in the place of a pattern.
Result<std::vector<NamedResult>> ReadResults(std::span<const std::string> arguments);

/// Does the same, but all arguments without names are one method, named after the only one, or "motions". Fails if some
/// have names and others have none.
Result<std::vector<NamedResult>> ReadMotions(std::span<const std::string> arguments);

/// Writes the methods of a scenario; one without patterns has no `answers`.
std::string MethodsInYaml(std::span<const NamedResult> results);

}  // namespace etude
