#include <fmt/core.h>

#include "bench/outside/conformance.h"
#include "bench/process/child_process.h"
#include "cli/commands.h"

namespace etude {

int CheckMethodCommand(OutsideOptions options, const std::string& seat, bool is_fenced) {
  AdoptOrphans();
  if (is_fenced) options.fence = Fence::Find();
  fmt::print("fence: {}\n", options.fence.description());
  int checks = 0, passed = 0;
  const auto all_passed = CheckConformance(options, seat, [&](const ConformanceCheck& check) {
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
