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

/// Adds --json, of every command that tells facts.
CLI::Option* AddJson(CLI::App& command, bool& as_json);

/// Prints what a command found out as one line of JSON: "command", "etude" (the version) and `facts`, an object. Its
/// schema is the entry of that name in docs/schemas/facts.schema.json.
Result<void> PrintFacts(const std::string& command, Json facts);

/// While it lives, what is printed for people goes to standard error: standard output is for facts alone.
class Aside {
 public:
  /// Does nothing unless `is_active`.
  explicit Aside(bool is_active);
  ~Aside() { End(); }
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;
  /// Gives standard output back.
  void End();

 private:
  int output_ = -1;  ///< where standard output went before; -1: it still goes there
};

/// Returns the moves of a comparison that are not "same", and what stands on one side alone.
Json FactsOf(const SnapshotComparison& comparison);

}  // namespace etude
