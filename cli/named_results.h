#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A method, and the file patterns of the method's answers.
struct NamedResult {
  std::string name;
  std::vector<std::string> patterns;
};

/// Reads arguments RESULT or NAME=PATTERN, one for each method. A method without a name is named after the folder or
/// file of its answers. Fails if there are several arguments and one of them has no name, because a shell may have
/// expanded a pattern into files.
Result<std::vector<NamedResult>> ReadResults(std::span<const std::string> arguments);

/// Reads arguments FILE or NAME=PATTERN. All arguments without a name form one method. This method is named after its
/// argument if it has only one, else "motions". Fails if some arguments have names and others have none.
Result<std::vector<NamedResult>> ReadMotions(std::span<const std::string> arguments);

/// Writes the methods of a scenario as YAML; a method without patterns gets no key `answers`.
std::string MethodsInYaml(std::span<const NamedResult> results);

}  // namespace etude
