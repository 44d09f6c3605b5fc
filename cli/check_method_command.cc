#include <fmt/core.h>

#include "bench/outside/conformance.h"
#include "cli/commands.h"

namespace etude {

int CheckMethodCommand(const std::vector<std::string>& command, const std::string& task, const std::string& seat,
                       double time_s, double memory_mb) {
  int checks = 0, passed = 0;
  const auto all_passed =
      CheckConformance({.command = command, .task = task, .time_s = time_s, .memory_mb = memory_mb}, seat,
                       [&](const ConformanceCheck& check) {
                         ++checks;
                         passed += check.passed ? 1 : 0;
                         fmt::print("{}  {}: {}\n", check.passed ? "passed" : "FAILED", check.name, check.found);
                         std::fflush(stdout);
                       });
  if (!all_passed) return Complain(all_passed.error());
  fmt::print("{} of {} checks passed{}\n", passed, checks,
             *all_passed ? "" : "; docs/outside-methods.md tells what a method has to do");
  return *all_passed ? kSuccess : kNothingWorked;
}

}  // namespace etude
