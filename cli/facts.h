#pragma once

#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "engine/base/result.h"
#include "io/files/json.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace etude {

/// Adds --json, for every command that prints facts.
CLI::Option* AddJson(CLI::App& command, bool& as_json);

/// Prints the findings of a command as one line of JSON: "command", "etude" (the version) and the members of `facts`,
/// an object. The entry of that name in docs/schemas/facts.schema.json is its schema.
Result<void> PrintFacts(const std::string& command, Json facts);

/// Redirects standard output to standard error during its lifetime, so that text for people does not mix with facts for
/// programs.
class StdoutToStderr {
 public:
  /// Has no effect unless `is_active`.
  explicit StdoutToStderr(bool is_active);
  ~StdoutToStderr() { End(); }
  StdoutToStderr(const StdoutToStderr&) = delete;
  StdoutToStderr& operator=(const StdoutToStderr&) = delete;
  /// Restores standard output.
  void End();

 private:
  int output_ = -1;  ///< a copy of the original standard output; −1 = not redirected
};

/// Returns the metrics that moved in a comparison, and the entries that only one side has.
Json FactsOf(const SnapshotComparison& comparison);

}  // namespace etude
