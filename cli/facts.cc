#include "cli/facts.h"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/base/utf8.h"

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

Result<void> CheckOutput(const std::string& path, bool overwrite, std::string_view ending) {
  namespace fs = std::filesystem;
  if (path.empty()) return {};
  if (!path.ends_with(ending)) return Fail({path, 0, 0}, "has the wrong ending; allowed: {}", ending);
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(path, ignored);
  if (!fs::exists(there)) return {};
  if (fs::is_directory(path, ignored)) return Fail({path, 0, 0}, "is a folder; allowed: a file name");
  // Refuse devices and pipes: WriteFileAtomically would replace a device instead of sending data to it.
  if (!fs::is_regular_file(there) && !fs::is_symlink(there)) {
    return Fail({path, 0, 0}, "is a device, pipe or socket; allowed: the name of an ordinary file");
  }
  if (overwrite) return {};
  return Fail({path, 0, 0}, "already exists; use --overwrite to replace this file");
}

void TellWritten(const std::string& path, std::FILE* stream) { fmt::print(stream, "written: {}\n", Visible(path)); }

}  // namespace etude
