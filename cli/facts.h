#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "io/files/json.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace etude {

/// Adds --json, for every command that prints facts.
CLI::Option* AddJson(CLI::App& command, bool& as_json);

/// Returns a value as JSON, null if there is none.
Json OrNull(const std::optional<double>& value);

/// Prints the findings of a command as one line of JSON with the members "command", "etude" (the version) and the
/// members of `facts`, which is an object. docs/schemas/facts.schema.json holds the schema of this line under the name
/// `command`.
Result<void> PrintFacts(const std::string& command, Json facts);

/// While an object of this class exists, it redirects standard output to standard error, so that text for people does
/// not mix with facts for programs.
class StdoutToStderr {
 public:
  /// Redirects only if `is_active`.
  explicit StdoutToStderr(bool is_active);
  ~StdoutToStderr() { End(); }
  StdoutToStderr(const StdoutToStderr&) = delete;
  StdoutToStderr& operator=(const StdoutToStderr&) = delete;
  /// Restores standard output.
  void End();

 private:
  int output_ = -1;  ///< a copy of the original standard output; −1 = not redirected
};

}  // namespace etude
