#include "bench/run/dry_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/statistics/beyond.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/distributions.h"
#include "bench/statistics/paired_tests.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "engine/base/names.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr double kSampleSeconds = 0.8;

std::string Duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", std::max(seconds, 1.0));
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

/// Returns a difference, given in standard deviations, in the unit of the scenario's metric: ", about 1.2 mm of joint
/// position error"; "" if the metric is unknown.
std::string InUnit(const ScenarioForecast& one, double deviations) {
  const MetricInfo* metric = FindMetric(one.metric);
  if (metric == nullptr || one.spread <= 0) return "";
  const MetricWords words = WordsFor(one.metric);
  return fmt::format(", about {} of {} (in practice, a difference of {:g}{} or more matters)",
                     ShortDifference(deviations * one.spread, words), words.label, metric->practical * words.scale,
                     words.is_share ? " pp" : words.difference_suffix);
}

/// Prints a forecast. Returns true if it names a difference that the run would find.
bool Print(const ScenarioForecast& one) {
  fmt::print("{} ({}): {} × {} × {} = {} cells, {:.2g} s a world{}\n", one.name, one.task,
             CountOf(one.conditions, "condition"), CountOf(one.worlds, "world"), CountOf(one.methods, "method"),
             one.conditions * one.worlds * one.methods, one.seconds_per_world,
             one.is_kept ? "" : ", measured just now on the first worlds");
  if (one.comparisons == 0) return false;
  const int worlds = static_cast<int>(one.worlds);
  const SamplingUnit world = one.unit == SamplingUnit::kPerson ? one.unit : SamplingUnit::kWorld;
  const std::string among = one.comparisons == 1 ? "1 comparison" : fmt::format("{} comparisons", one.comparisons);
  const std::string_view shows = one.comparisons == 1 ? "detects" : "detect";
  const int for_values = PairsNeeded(one.comparisons, kAlpha);
  if (worlds < one.needed) {
    fmt::print(
        "  verdicts about these worlds: at least {} are needed to judge a method better or worse; the run has {}\n",
        CountUnits(one.needed, world), worlds);
  } else if (worlds < for_values) {
    fmt::print(
        "  verdicts about these worlds: at least {} are needed to judge metric values in {}; with fewer, only success "
        "rates or the worst worlds can decide a verdict\n",
        CountUnits(for_values, world), among);
  } else {
    const double least = MinDetectableDifference(worlds, one.comparisons);
    fmt::print(
        "  verdicts about these worlds: {} {} a mean difference of at least {:.2f} standard deviations of the "
        "per-world differences{}\n",
        among, shows, least, InUnit(one, least));
  }
  if (WorldsAreUnits(one.unit)) return worlds >= for_values;
  if (one.units < kMinUnits) {
    fmt::print("  verdicts about {}: not possible with {}; at least {} are needed\n", OtherUnits(one.unit),
               CountUnits(one.units, one.unit), kMinUnits);
    return worlds >= for_values;
  }
  fmt::print(
      "  verdicts about {}: {} {} a difference of at least {:.2f} standard deviations of the mean differences of {}\n",
      OtherUnits(one.unit), among, shows, MinDetectableDifference(one.units, one.comparisons),
      CountUnits(one.units, one.unit));
  return true;
}

Json FactsOf(const Forecast& forecast, const Shard& shard) {
  Json scenarios = Json::array();
  for (const ScenarioForecast& one : forecast.scenarios) {
    scenarios.push_back({{"scenario", one.name},
                         {"task", one.task},
                         {"conditions", one.conditions},
                         {"worlds", one.worlds},
                         {"worlds_needed", one.needed},
                         {"methods", one.methods},
                         {"comparisons", one.comparisons},
                         {"units", one.units},
                         {"work", one.work},
                         {"kept", one.is_kept},
                         {"world_s", one.seconds_per_world},
                         {"metric", one.metric},
                         {"spread", one.spread > 0 ? Json(one.spread) : Json(nullptr)}});
  }
  return {{"shard", shard.IsWhole() ? Json(nullptr) : Json(ToString(shard))},
          {"cells", forecast.cells},
          {"run_s", forecast.seconds},
          {"workers", forecast.workers},
          {"yardstick_ms", forecast.pace.yardstick_ms},
          {"scenarios", std::move(scenarios)}};
}

}  // namespace

int DryRunCommand(const RunOptions& options, bool as_json) {
  const auto forecast = DryRun(options, kSampleSeconds);
  if (!forecast) return Complain(forecast.error());
  for (const RefusedClip& one : forecast->refused) Complain({{one.clip}, "is left out: " + one.why});
  if (as_json) {
    const auto printed = PrintFacts("run --dry-run", FactsOf(*forecast, options.shard));
    return printed ? kSuccess : Complain(printed.error());
  }
  std::size_t all = 0;
  bool shows_differences = false;
  std::vector<std::string> guessed;
  for (const ScenarioForecast& one : forecast->scenarios) {
    shows_differences = Print(one) || shows_differences;
    all += one.conditions * one.worlds * one.methods;
    if (!one.is_kept) guessed.push_back(one.name);
  }
  if (!options.shard.IsWhole())
    fmt::print("Shard {}: {} of {} cells.\n", ToString(options.shard), forecast->cells, all);
  fmt::print("{} cells; the run takes about {} on {}.{} Nothing was written.\n", forecast->cells,
             Duration(forecast->seconds), CountOf(static_cast<std::size_t>(forecast->workers), "worker"),
             shows_differences ? " The probability of detecting these differences is 80 %." : "");
  if (!guessed.empty()) {
    fmt::print("The time is an estimate: the costs of {} are unknown, so Etude measured their first worlds just now.\n",
               Join(guessed, ", "));
  }
  return kSuccess;
}

}  // namespace etude
