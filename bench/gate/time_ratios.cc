#include "bench/gate/time_ratios.h"

#include <map>
#include <utility>

#include "bench/gate/snapshot.h"
#include "bench/statistics/bootstrap.h"

namespace etude {
namespace {

/// By world (condition, trial): the times of one method. Cells that ended because of the machine, or sooner than
/// the clock ticks, have none.
std::map<std::pair<std::string, int>, double> SecondsOf(const FinishedRun& run, const std::string& scenario,
                                                        const std::string& method) {
  std::map<std::pair<std::string, int>, double> seconds;
  ForEachRow(run.data, [&](const Row& row, std::size_t place) {
    if (row.scenario != scenario || row.method != method) return;
    const double measured = CpuSecondsOf(run.data, row, place).value_or(0);
    if (measured <= 0 || DependsOnMachine(StatusLetter(row.result.status))) return;
    seconds[{CompactLabel(row.condition), row.trial}] = measured;
  });
  return seconds;
}

RatioResult Judge(const FinishedRun& run, const FinishedScenario& scenario, const TimeRatio& rule) {
  RatioResult result{scenario.study.scenario, rule, 0, {}, {}, {}, Ruling::kUndecided};
  const auto over = SecondsOf(run, result.scenario, rule.over);
  std::vector<double> ratios;
  for (const auto& [world, seconds] : SecondsOf(run, result.scenario, rule.of)) {
    if (const auto other = over.find(world); other != over.end()) ratios.push_back(seconds / other->second);
  }
  result.pairs = static_cast<int>(ratios.size());
  if (ratios.empty()) return result;
  result.median = Quantile(ratios, 0.5);
  const auto interval = BootstrapInterval(ratios, Aggregate::kMedian, scenario.seed,
                                          fmt::format("time/{}/{}/{}", result.scenario, rule.of, rule.over));
  if (!interval) return result;
  result.ci_low = interval->low;
  result.ci_high = interval->high;
  if (*result.median <= rule.at_most) {
    result.ruling = Ruling::kMet;
  } else if (interval->low > rule.at_most) {
    result.ruling = Ruling::kUnmet;
  }
  return result;
}

}  // namespace

std::vector<RatioResult> JudgeTimeRatios(const FinishedRun& run) {
  std::vector<RatioResult> results;
  for (const FinishedScenario& scenario : run.scenarios) {
    for (const TimeRatio& rule : scenario.study.gate.time_ratios) results.push_back(Judge(run, scenario, rule));
  }
  return results;
}

}  // namespace etude
