#include <fmt/core.h>

#include <algorithm>

#include "bench/run/dry_run.h"
#include "bench/statistics/beyond.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/distributions.h"
#include "cli/commands.h"

namespace etude {
namespace {

constexpr double kSampleSeconds = 10;

std::string Duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", std::max(seconds, 1.0));
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string CountOf(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void Print(const ScenarioForecast& one) {
  fmt::print("{} ({}): {} × {} × {} = {} cells, {:.2g} s a world\n", one.name, one.task,
             CountOf(one.conditions, "condition"), CountOf(one.worlds, "world"), CountOf(one.methods, "method"),
             one.conditions * one.worlds * one.methods, one.seconds_per_world);
  if (one.comparisons == 0) return;
  const int worlds = static_cast<int>(one.worlds);
  const std::string among = one.comparisons == 1 ? "1 comparison" : fmt::format("{} comparisons", one.comparisons);
  if (worlds < kSmallestSample) {
    fmt::print("  on these worlds: no verdict; at least {} are needed\n", kSmallestSample);
  } else {
    fmt::print(
        "  on these worlds: {} {} a mean difference from {:.2f} standard deviations of the worlds' "
        "differences\n",
        among, one.comparisons == 1 ? "shows" : "show", SmallestFinding(worlds, one.comparisons));
  }
  if (IsEveryWorldItsOwn(one.unit)) return;
  if (one.units < kFewestUnits) {
    fmt::print("  beyond them: no verdict: {}; at least {} are needed\n", CountUnits(one.units, one.unit),
               kFewestUnits);
    return;
  }
  fmt::print("  beyond them: from {:.2f} standard deviations of the mean differences of {}\n",
             SmallestFinding(one.units, one.comparisons), CountUnits(one.units, one.unit));
}

}  // namespace

int DryRunCommand(const RunOptions& options) {
  const auto forecast = DryRun(options, kSampleSeconds);
  if (!forecast) return Complain(forecast.error());
  std::size_t cells = 0;
  for (const ScenarioForecast& one : forecast->scenarios) {
    Print(one);
    cells += one.conditions * one.worlds * one.methods;
  }
  fmt::print("{} cells, about {} on {}. Differences that are found with a chance of 80 %. Nothing was written.\n",
             cells, Duration(forecast->seconds), CountOf(static_cast<std::size_t>(forecast->workers), "worker"));
  return kSuccess;
}

}  // namespace etude
