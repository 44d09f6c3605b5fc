#include "cli/commands.h"

#include <fmt/core.h>

#include <cstdio>

#include "bench/model/run_data.h"
#include "bench/process/machine.h"

namespace etude {

int Complain(const Error& error) {
  std::fputs(("etude: " + ToString(error) + "\n").c_str(), stderr);
  return IsOfThisMachine(error) ? kIncomplete : kUnusableInput;
}

int Finish(const Result<int>& code) { return code ? *code : Complain(code.error()); }

int TellStopped(const Error& what_is_left) {
  Complain(what_is_left);
  return kInterrupted;
}

void TellUnsealed(const RunData& run) {
  if (!run.unsealed.empty()) std::fputs(("etude: read unsealed: " + run.unsealed + "\n").c_str(), stderr);
}

void PrintList(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  fmt::print("{}\n", title);
  for (const std::string& line : lines) fmt::print("  {}\n", line);
}

}  // namespace etude
