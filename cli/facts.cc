#include "cli/facts.h"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace etude {

CLI::Option* AddJson(CLI::App& command, bool& as_json) {
  return command.add_flag("--json", as_json, "Print JSON (docs/schemas/facts.schema.json)");
}

Json OrNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Result<void> PrintFacts(const std::string& command, Json facts) {
  Json all = {{"command", command}, {"etude", ETUDE_VERSION}};
  all.update(facts);
  ASSIGN_OR_RETURN(const auto text, WriteJson(all));
  fmt::print("{}\n", text);
  return {};
}

StdoutToStderr::StdoutToStderr(bool is_active) {
  if (!is_active) return;
  std::fflush(stdout);
  output_ = ::dup(STDOUT_FILENO);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

void StdoutToStderr::End() {
  if (output_ < 0) return;
  std::fflush(stdout);
  ::dup2(output_, STDOUT_FILENO);
  ::close(output_);
  output_ = -1;
}

}  // namespace etude
