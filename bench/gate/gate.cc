#include "bench/gate/gate.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "bench/metrics/catalogue.h"
#include "bench/model/reasons.h"
#include "bench/statistics/bootstrap.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// Returns the processor times of one method's cells, seconds, by world (condition, trial). A cell is left out if its
/// status depends on the machine (DependsOnMachine), or if the cell took less time than the clock can resolve.
std::map<std::pair<std::string, int>, double> SecondsOf(const FinishedRun& run, const std::string& scenario,
                                                        const std::string& method) {
  std::map<std::pair<std::string, int>, double> seconds;
  ForEachRow(run.data, [&](const Row& row, std::size_t place) {
    if (row.scenario != scenario || row.method != method) return;
    const double measured = CpuSecondsOf(run.data, row, place).value_or(0);
    if (measured <= 0 || DependsOnMachine(row.result.status)) return;
    seconds[{CompactLabel(row.condition), row.trial}] = measured;
  });
  return seconds;
}

/// Returns the median over worlds, seconds; 0 without worlds.
double MedianOf(const std::map<std::pair<std::string, int>, double>& seconds) {
  std::vector<double> values;
  for (const auto& [world, value] : seconds) values.push_back(value);
  return values.empty() ? 0 : Quantile(values, 0.5);
}

RatioResult Judge(const FinishedRun& run, const FinishedScenario& scenario, const TimeRatio& rule) {
  RatioResult result{scenario.study.scenario, rule, 0, {}, {}, {}, ClaimOutcome::kUndecided};
  const auto of = SecondsOf(run, result.scenario, rule.of), over = SecondsOf(run, result.scenario, rule.over);
  std::vector<double> ratios;
  for (const auto& [world, seconds] : of) {
    if (const auto other = over.find(world); other != over.end()) ratios.push_back(seconds / other->second);
  }
  result.pairs = static_cast<int>(ratios.size());
  if (ratios.empty()) return result;
  result.median = Quantile(ratios, 0.5);
  // Cold caches lengthen a short time: that of `of` raises the ratio, that of `over` lowers it.
  const bool is_met = *result.median <= rule.at_most;
  const double decisive = MedianOf(is_met ? over : of);
  if (decisive < kMinJudgedSeconds) result.too_short_s = decisive;
  const auto interval = BootstrapInterval(ratios, Aggregate::kMedian, scenario.seed, "time/" + result.scenario);
  if (!interval) return result;
  result.ci_low = interval->low;
  result.ci_high = interval->high;
  if (result.too_short_s) return result;
  if (is_met) {
    result.outcome = ClaimOutcome::kMet;
  } else if (interval->low > rule.at_most) {
    result.outcome = ClaimOutcome::kUnmet;
  }
  return result;
}

Result<void> RequireComparable(const Snapshot& baseline, const Snapshot& now, const std::string& file) {
  const std::vector<std::string> reasons = WhyNotComparable(baseline, now);
  if (reasons.empty()) return {};
  constexpr std::size_t kMaxShownReasons = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMaxShownReasons, reasons.size()); ++i)
    text += (i == 0 ? "" : "; ") + reasons[i];
  if (reasons.size() > kMaxShownReasons) text += fmt::format("; and {} more", reasons.size() - kMaxShownReasons);
  return Fail({file, 0, 0}, "this baseline and the run have different worlds: {}; --update writes a new baseline",
              text);
}

}  // namespace

std::vector<RatioResult> JudgeTimeRatios(const FinishedRun& run) {
  std::vector<RatioResult> results;
  for (const FinishedScenario& scenario : run.scenarios) {
    for (const TimeRatio& rule : scenario.study.gate.time_ratios) results.push_back(Judge(run, scenario, rule));
  }
  return results;
}

std::set<std::string> ExactScenarios(const FinishedRun& run) {
  std::set<std::string> exact;
  for (const FinishedScenario& one : run.scenarios) {
    if (one.study.gate.exact) exact.insert(one.study.scenario);
  }
  return exact;
}

TailRules TailRulesOf(const FinishedRun& run) {
  TailRules tails;
  for (const FinishedScenario& one : run.scenarios) tails[one.study.scenario] = one.study.gate.tail;
  return tails;
}

std::vector<std::string> WhyIncomplete(const FinishedRun& run) {
  if (!run.incomplete.empty()) return run.incomplete;
  struct Ends {
    int cells = 0;
    std::string first;
  };
  std::map<std::pair<std::string, std::string>, Ends> ends;  // how cells of each scenario ended, by scenario and status
  bool all_skipped = true;
  std::string why_skipped;
  ForEachRow(run.data, [&](const Row& row, std::size_t) {
    all_skipped = all_skipped && row.result.status == Status::kSkipped;
    if (all_skipped && why_skipped.empty()) why_skipped = fmt::format("{}: {}", row.Id(), row.result.reason);
    if (!DependsOnMachine(row.result.status)) return;
    Ends& found = ends[{row.scenario, std::string(StatusName(row.result.status))}];
    if (found.cells++ == 0) found.first = fmt::format("{}: {}", row.Id(), row.result.reason);
  });
  std::vector<std::string> sentences;
  for (const auto& [key, found] : ends) {
    sentences.push_back(
        fmt::format("{}: {} × status {}, a status that depends on the machine; the first such cell is {}", key.first,
                    found.cells, key.second, found.first));
  }
  if (all_skipped && !why_skipped.empty())
    sentences.push_back("every cell was skipped; the first cell is " + why_skipped);
  return sentences;
}

namespace {

/// The cells of one method, or of one metric.
struct SilentCells {
  int attempted = 0;
  bool has_answer = false;
  std::string first;
  ReasonCounts causes;

  void Add(const Row& row, bool answers, const std::string& reason, const std::string& before) {
    constexpr std::size_t kMaxKeptCauses = 1000;
    has_answer |= answers;
    if (attempted++ == 0) first = row.Id();
    if (!has_answer && causes.size() < kMaxKeptCauses) causes.Add(reason, before);
  }

  /// Returns "; the first cell is ..." with the most frequent reasons.
  std::string Details() const {
    constexpr std::size_t kMaxShownCauses = 3;
    const std::vector<CountedReason> most = causes.MostFrequentFirst();
    std::string text = "; the first cell is " + first;
    for (std::size_t i = 0; i < std::min(most.size(), kMaxShownCauses); ++i) {
      text += fmt::format("; {} × {}", most[i].cells, most[i].Words());
    }
    return most.size() > kMaxShownCauses ? text + "; and others" : text;
  }
};

}  // namespace

std::vector<std::string> DescribeSilent(const FinishedRun& run) {
  // List the own metrics that the gate judges: all of a scenario, unless its gate names metrics.
  std::map<std::string, std::set<std::string>> judged;
  for (const FinishedScenario& scenario : run.scenarios) {
    const std::vector<std::string>& named = scenario.study.gate.metrics;
    for (const auto& [id, metric] : AddedMetrics()) {
      if (named.empty() || std::ranges::find(named, id) != named.end()) judged[scenario.study.scenario].insert(id);
    }
  }
  // Collect the reasons why cells have no answer, and why cells with an answer have no value of an own metric.
  std::map<std::pair<std::string, std::string>, SilentCells> methods, metrics;
  ForEachRow(run.data, [&](const Row& row, std::size_t) {
    const CellResult& result = row.result;
    if (result.status == Status::kSkipped) return;
    methods[{row.scenario, row.method}].Add(row, HasAnswer(result), result.reason,
                                            fmt::format("{}: ", StatusName(result.status)));
    for (const MetricValue& metric : result.metrics) {
      if (!judged[row.scenario].contains(metric.id)) continue;
      metrics[{row.scenario, metric.id}].Add(row, metric.value.has_value(), metric.null_reason, "");
    }
  });
  std::vector<std::string> sentences;
  for (const auto& [name, cells] : methods) {
    if (cells.has_answer) continue;
    sentences.push_back(fmt::format("{}: none of the {} cells of {} has an answer{}", name.first, cells.attempted,
                                    name.second, cells.Details()));
  }
  for (const auto& [name, cells] : metrics) {
    if (cells.has_answer) continue;
    sentences.push_back(fmt::format("{}: none of the {} cells with an answer has a value of your metric {}{}",
                                    name.first, cells.attempted, name.second, cells.Details()));
  }
  return sentences;
}

Result<GateReport> JudgeRun(const FinishedRun& run, const Snapshot* baseline, const std::string& baseline_file) {
  GateReport report;
  report.suite = run.data.suite;
  report.program_version = run.data.program_version;
  report.baseline_file = baseline_file;
  report.incomplete = run.incomplete;
  for (const ScenarioSummary& scenario : run.data.scenarios) {
    for (const ExpectationResult& result : scenario.expectations)
      report.expectations.push_back({scenario.name, result});
    for (const ConditionSummary& condition : scenario.conditions) {
      for (const Answer& answer : condition.answers) {
        report.answers.push_back({scenario.name, CompactLabel(condition.condition), answer});
      }
    }
  }
  if (!report.incomplete.empty()) return report;
  // Find the cells that prevent a verdict, the methods without any answer, and own metrics without any value.
  report.incomplete = WhyIncomplete(run);
  report.silent = DescribeSilent(run);
  for (const FinishedScenario& scenario : run.scenarios) {
    for (const ComparedMethod& method : scenario.study.methods) report.runs_programs |= method.settings.empty();
  }
  // Judge the rules on processor times, and compare with the baseline.
  report.ratios = JudgeTimeRatios(run);
  if (baseline == nullptr) return report;
  report.baseline_version = baseline->program_version;
  const Snapshot now = TakeSnapshot(run);
  RETURN_IF_ERROR(RequireComparable(*baseline, now, baseline_file));
  report.comparison = CompareSnapshots(*baseline, now, ExactScenarios(run), TailRulesOf(run));
  report.worsened = FindWorsenedAnswers(run, *baseline, now, report.comparison.moves);
  for (const std::string& name : report.comparison.only_before) {
    report.incomplete.push_back("the baseline contains values that the run lacks: " + name);
  }
  return report;
}

bool IsRegression(const MetricMove& move) {
  return move.movement == Movement::kWorse || move.movement == Movement::kChanged;
}

GateVerdict GateVerdictOf(const GateReport& report) {
  if (!report.incomplete.empty()) return GateVerdict::kIncomplete;
  const auto unmet = [](const auto& judged) { return judged.outcome == ClaimOutcome::kUnmet; };
  const bool fails = !report.silent.empty() || std::ranges::any_of(report.worsened, &WorsenedAnswer::IsReversed) ||
                     std::any_of(report.comparison.moves.begin(), report.comparison.moves.end(), IsRegression) ||
                     std::any_of(report.ratios.begin(), report.ratios.end(), unmet) ||
                     std::any_of(report.expectations.begin(), report.expectations.end(),
                                 [&](const GateExpectation& expectation) { return unmet(expectation.result); });
  return fails ? GateVerdict::kRegressed : GateVerdict::kPassed;
}

}  // namespace etude
