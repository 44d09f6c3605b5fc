#include "reports/words/findings.h"

#include <algorithm>
#include <map>
#include <utility>

#include "bench/model/judged_time.h"
#include "engine/base/order_statistics.h"
#include "reports/words/answer.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

// If there are more methods than this, a sentence on success names only the least and the most successful method.
constexpr std::size_t kMaxSuccesses = 12;

std::string ExpectationsSentence(const RunFindings& f) {
  const int all = f.met + f.unmet + f.undecided;
  if (all == 0) return "";
  std::string text;
  if (f.met == all) {
    text = all == 1 ? "The only expectation was met" : fmt::format("All {} expectations were met", all);
  } else {
    text = fmt::format("{} of {} were met", f.met, Plural(all, "expectation"));
    if (f.unmet > 0) text += fmt::format(", {} {} not met", f.unmet, f.unmet == 1 ? "was" : "were");
    if (f.undecided > 0) text += fmt::format(", {} {} undecided", f.undecided, f.undecided == 1 ? "is" : "are");
  }
  return text + ". ";
}

/// Returns a sentence that says how many cells were measured. (SuccessSentence says how many cells reached the goal.)
std::string MeasuredSentence(const RunFindings& f) {
  if (f.cells == 0) return "No cell ran.";
  const int measured = f.ok + f.unsolved;  // cells with an answer
  std::string text = f.cells == 1 ? fmt::format("The only cell was{} measured", measured == 1 ? "" : " not")
                     : measured == f.cells
                         ? fmt::format("All {} cells were measured", FormatCount(f.cells))
                         : fmt::format("{} of {} cells were measured", FormatCount(measured), FormatCount(f.cells));
  if (f.unsolved > 0)
    text += fmt::format(", {} of them unsolved (the answer missed the goal)", FormatCount(f.unsolved));
  if (f.unanswered > 0) text += fmt::format(", {} without an answer", FormatCount(f.unanswered));
  if (f.skipped > 0) text += fmt::format(", {} were skipped", FormatCount(f.skipped));
  if (f.broken > 0) text += fmt::format(", {} could not be measured", FormatCount(f.broken));
  return text + ".";
}

/// Computes the mean of each success metric for each method. Metrics that occur in no row are left out.
class Successes {
 public:
  Successes() {
    for (const MetricInfo& metric : AllMetrics()) {
      if (metric.is_success) sums_.emplace_back(metric.id, Sums());
    }
  }

  void Add(const Row& row) {
    for (auto& [metric, sums] : sums_) {
      const auto value = ValueOf(row, metric);
      if (!value) continue;
      auto& [sum, count] = sums[row.method];
      sum += *value;
      ++count;
    }
  }

  std::vector<SuccessFinding> Of(const ScenarioSummary& scenario) const {
    std::vector<SuccessFinding> successes;
    for (const auto& [metric, sums] : sums_) {
      if (sums.empty()) continue;
      SuccessFinding& finding = successes.emplace_back(SuccessFinding{metric, {}});
      for (const std::string& method : scenario.methods) {
        const auto found = sums.find(method);
        if (found != sums.end()) finding.shares.emplace_back(method, found->second.first / found->second.second);
      }
    }
    return successes;
  }

 private:
  using Sums = std::map<std::string, std::pair<double, int>>;
  std::vector<std::pair<std::string, Sums>> sums_;
};

class Times {
 public:
  void Add(const RunData& run, const Row& row, std::size_t place) {
    if (const auto seconds = CpuSecondsOf(run, row, place)) seconds_[row.method].push_back(*seconds);
  }

  std::optional<double> MedianOf(const std::string& method) const {
    const auto found = seconds_.find(method);
    return found == seconds_.end() ? std::nullopt : std::optional(Median(found->second));
  }

 private:
  std::map<std::string, std::vector<double>> seconds_;
};

std::string TimeText(std::optional<double> seconds) {
  if (!seconds) return std::string(kNoValue);
  if (*seconds < kMinJudgedSeconds) return FormatNumber(*seconds * 1000) + " ms (too short to judge)";
  return *seconds < 1 ? FormatNumber(*seconds * 1000) + " ms" : FormatNumber(*seconds) + " s";
}

/// Returns the range of a method's typical values of a metric over conditions: "0.06–0.08°".
std::string ValuesOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric) {
  const MetricWords words = WordsFor(metric);
  std::optional<double> low, high;
  for (const ConditionSummary& condition : scenario.conditions) {
    const auto found = std::ranges::find(condition.methods, method, &MethodSummary::method);
    const MetricSummary* summary = found == condition.methods.end() ? nullptr : FindSummary(*found, metric);
    const auto value = summary == nullptr ? std::nullopt : TypicalValue(*summary, words);
    if (!value) continue;
    low = std::min(low.value_or(*value), *value);
    high = std::max(high.value_or(*value), *value);
  }
  return low == high ? FormatValue(low, words) : FormatInterval(low, high, words) + words.suffix;
}

/// Returns the share of a method's cells that reached the task's goal. If the scenario has no success metric, returns
/// the share of cells that ended ok.
std::string SuccessOf(const ScenarioFindings& findings, const ScenarioSummary& scenario, const std::string& method) {
  if (!findings.successes.empty()) {
    const SuccessFinding& success = findings.successes.front();
    const auto found = std::ranges::find(success.shares, method, &std::pair<std::string, double>::first);
    return found == success.shares.end() ? std::string(kNoValue) : FormatValue(found->second, WordsFor(success.metric));
  }
  int ok = 0, attempted = 0;
  for (const ConditionSummary& condition : scenario.conditions) {
    const auto found = std::ranges::find(condition.methods, method, &MethodSummary::method);
    if (found == condition.methods.end()) continue;
    ok += found->ok;
    attempted += found->attempted;
  }
  return FormatShare(ok, attempted);
}

/// Returns the methods with which method `asked` is compared, each method once: first the baselines, then the strongest
/// other methods.
std::vector<std::string> OthersBeside(const ScenarioSummary& scenario, const std::string& asked,
                                      const std::string& metric) {
  std::vector<std::string> names;
  for (const Against against : {Against::kBaseline, Against::kRival}) {
    for (const Judged& judged : JudgedOf(scenario, asked, metric, against)) {
      for (std::string& name : BaselinesOf(judged)) {
        if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
      }
    }
  }
  constexpr std::size_t kMaxOthers = 3;
  names.resize(std::min(names.size(), kMaxOthers));
  return names;
}

/// Returns "12/60": the number of worlds, over all conditions, in which method `other` is worse than method `asked` by
/// at least the practical threshold, and the number of paired worlds.
std::string WorldsLostTo(const ScenarioSummary& scenario, const std::string& asked, const std::string& other,
                         const std::string& metric) {
  for (const Against against : {Against::kBaseline, Against::kRival}) {
    int lost = 0, pairs = 0;
    for (const Judged& judged : JudgedOf(scenario, asked, metric, against)) {
      if (judged.comparison->baseline != other) continue;
      lost += judged.comparison->better;
      pairs += judged.comparison->pairs;
    }
    if (pairs > 0) return fmt::format("{}/{}", FormatCount(lost), FormatCount(pairs));
  }
  return "";  // the rival is a pair of methods, one for each half of the worlds
}

KeyFigures KeyFiguresOf(const ScenarioSummary& scenario, const std::string& asked, Times& times,
                        const ScenarioFindings& findings) {
  KeyFigures figures;
  const std::string& metric = findings.metric;
  std::vector<std::string> names = OthersBeside(scenario, asked, metric);
  if (names.empty()) return figures;
  names.insert(names.begin(), asked);
  for (const std::string& name : names) figures.methods.push_back({name, {}});
  const auto add = [&](std::string label, const auto& value_of) {
    figures.labels.push_back(std::move(label));
    for (KeyFigures::Method& method : figures.methods) method.values.push_back(value_of(method.name));
  };
  add(WordsFor(metric).label, [&](const std::string& method) { return ValuesOf(scenario, method, metric); });
  if (findings.successes.empty() || findings.successes.front().metric != metric) {
    add(findings.successes.empty() ? "cells with status ok" : WordsFor(findings.successes.front().metric).plain_label,
        [&](const std::string& method) { return SuccessOf(findings, scenario, method); });
  }
  if (times.MedianOf(asked)) {
    add("processor time", [&](const std::string& method) { return TimeText(times.MedianOf(method)); });
  }
  add(fmt::format("worlds in which “{}” is better", asked),
      [&](const std::string& method) { return method == asked ? "" : WorldsLostTo(scenario, asked, method, metric); });
  return figures;
}

}  // namespace

std::string MethodFinding::BothVerdicts() const {
  if (!is_compared) return Words();
  if (beyond.on_these_only) return fmt::format("{}, no verdict for {}", Words(), OtherUnits(unit));
  return fmt::format("{}, {} for {}", Words(), VerdictWords(beyond.verdict), OtherUnits(unit));
}

bool HasOtherRival(const ScenarioFindings& findings) {
  return findings.rival.is_compared && findings.rival.others != findings.answer.others;
}

const MetricSummary* FindSummary(const MethodSummary& method, const std::string& metric) {
  return FindByName(method.metrics, metric, &MetricSummary::id);
}

std::vector<std::string> TableMetrics(const ScenarioSummary& scenario) {
  std::vector<std::string> metrics = scenario.headline_metrics;
  const auto falls_short = [](const ConditionSummary& condition, const std::string& metric) {
    return std::ranges::any_of(condition.methods, [&](const MethodSummary& method) {
      const MetricSummary* summary = FindSummary(method, metric);
      return summary != nullptr && summary->mean && *summary->mean < 1;
    });
  };
  for (const MetricInfo& metric : AllMetrics()) {
    if (!metric.is_success || std::ranges::find(metrics, metric.id) != metrics.end()) continue;
    const auto is_short = [&](const ConditionSummary& condition) { return falls_short(condition, metric.id); };
    if (std::ranges::any_of(scenario.conditions, is_short)) metrics.push_back(metric.id);
  }
  return metrics;
}

namespace {

/// Lists the reasons that were counted by status and method, the most frequent first.
std::vector<ReasonCount> MostFrequentFirst(const std::map<std::pair<Status, std::string>, ReasonCounts>& reasons) {
  std::vector<ReasonCount> list;
  for (const auto& [key, counts] : reasons) {
    for (CountedReason& one : counts.MostFrequentFirst()) list.push_back({std::move(one), key.first, key.second});
  }
  std::ranges::stable_sort(list, std::ranges::greater{}, &ReasonCount::cells);
  return list;
}

}  // namespace

std::string DescribeCount(const ReasonCount& reason) {
  const std::string_view what = reason.status == Status::kOk ? "doubtful" : StatusName(reason.status);
  return fmt::format("{} × {} in {}: {}", FormatCount(reason.cells), what, reason.method, reason.Words());
}

std::vector<FailureCount> FailuresOf(const RunData& run) {
  std::map<std::string, std::map<std::pair<Status, std::string>, ReasonCounts>> reasons;  // by scenario
  std::map<std::pair<std::string, std::string>, int> attempted;                           // by scenario and method
  ForEachRow(run, [&](const Row& row, std::size_t) {
    if (row.result.status == Status::kSkipped) return;
    ++attempted[{row.scenario, row.method}];
    if (HasAnswer(row.result)) return;
    reasons[row.scenario][{row.result.status, row.method}].Add(WithoutDoubts(row.result.reason));
  });
  std::vector<FailureCount> failures;
  for (const ScenarioSummary& scenario : run.scenarios) {
    for (ReasonCount& one : MostFrequentFirst(reasons[scenario.name])) {
      const int of = attempted[{scenario.name, one.method}];
      failures.push_back({std::move(one), scenario.name, of});
    }
  }
  return failures;
}

std::string DescribeFailure(const FailureCount& failure) {
  return fmt::format("{}: {} of {} of {} in {}: {}", StatusName(failure.status), FormatCount(failure.cells),
                     Plural(failure.of, "cell"), failure.method, failure.scenario, failure.Words());
}

ScenarioFindings FindingsOf(const RunData& run, const ScenarioSummary& scenario) {
  ScenarioFindings findings;
  if (!scenario.headline_metrics.empty()) findings.metric = scenario.headline_metrics.front();
  const std::string asked = MethodInQuestion(scenario);
  // Compare the method in question with its baseline and with the strongest other method.
  if (asked.empty()) {
    findings.answer.verdict = Verdict::kUndecided;
    // A search for faults needs no second method.
    if (scenario.task != "plausibility")
      findings.answer.sentence = scenario.methods.size() < 2
                                     ? "There is no comparison, because only one method ran."
                                     : "There is no comparison, because no method is compared with another method.";
  } else {
    findings.headline = HeadlineOf(scenario, asked, findings.metric);
    findings.answer = CompareInWords(scenario, asked, findings.metric, Against::kBaseline);
    findings.rival = CompareInWords(scenario, asked, findings.metric, Against::kRival);
  }
  // List all methods that are compared with others, and the yardsticks (methods that are compared with no method, such
  // as natural motion).
  for (std::size_t i = 1; i < scenario.methods.size(); ++i) {
    if (IsYardstick(scenario, scenario.methods[i])) {
      findings.yardsticks.push_back(scenario.methods[i]);
    } else if (!IsComparedWithNone(scenario, scenario.methods[i])) {
      findings.methods.push_back(CompareInWords(scenario, scenario.methods[i], findings.metric, Against::kBaseline));
    }
  }

  // Count the statuses and reasons of the cells in one pass over all rows.
  std::map<Status, int> statuses;
  std::map<std::pair<Status, std::string>, ReasonCounts> reasons;
  Successes successes;
  Times times;
  ForEachRow(run, [&](const Row& row, std::size_t place) {
    if (row.scenario != scenario.name) return;
    ++findings.cells;
    ++statuses[row.result.status];
    if (row.result.status != Status::kOk) {
      reasons[{row.result.status, row.method}].Add(WithoutDoubts(row.result.reason));
    }
    const std::vector<std::string> doubts = DoubtsIn(row.result.reason);
    for (const std::string& doubt : doubts) reasons[{Status::kOk, row.method}].Add(doubt);
    findings.doubtful += doubts.empty() ? 0 : 1;
    successes.Add(row);
    times.Add(run, row, place);
  });
  findings.successes = successes.Of(scenario);
  if (!asked.empty()) findings.figures = KeyFiguresOf(scenario, asked, times, findings);
  findings.statuses.assign(statuses.begin(), statuses.end());
  // List the reasons, the most frequent first.
  for (ReasonCount& one : MostFrequentFirst(reasons)) {
    (one.status == Status::kOk ? findings.doubts : findings.reasons).push_back(std::move(one));
  }
  return findings;
}

RunFindings FindingsOf(const RunData& run) {
  RunFindings f;
  // Count how many cells were measured, unsolved, skipped or broken.
  ForEachRow(run, [&](const Row& row, std::size_t) {
    ++f.cells;
    switch (row.result.status) {
      case Status::kOk:
        ++f.ok;
        break;
      case Status::kUnsolved:
        ++(HasAnswer(row.result) ? f.unsolved : f.unanswered);
        break;
      case Status::kSkipped:
        ++f.skipped;
        break;
      default:
        ++f.broken;
    }
  });
  // Count how many expectations were met, unmet and undecided.
  for (const ScenarioSummary& scenario : run.scenarios) {
    for (const ExpectationResult& expectation : scenario.expectations) {
      if (expectation.outcome == ClaimOutcome::kMet) ++f.met;
      if (expectation.outcome == ClaimOutcome::kUnmet) ++f.unmet;
      if (expectation.outcome == ClaimOutcome::kUndecided) ++f.undecided;
    }
  }
  f.sentence = ExpectationsSentence(f) + MeasuredSentence(f);
  return f;
}

std::string SuccessSentence(const SuccessFinding& finding) {
  const MetricWords words = WordsFor(finding.metric);
  std::string text = fmt::format("Reached ({}):", words.label);
  const auto share = [&](const auto& of) { return fmt::format(" {} {}", of.first, FormatValue(of.second, words)); };
  if (finding.shares.size() > kMaxSuccesses) {
    const auto [least, most] = std::ranges::minmax_element(finding.shares, {}, &std::pair<std::string, double>::second);
    return fmt::format("{} from{} to{}, of {}.", text, share(*least), share(*most),
                       Plural(static_cast<long long>(finding.shares.size()), "method"));
  }
  for (const auto& of : finding.shares) text += share(of) + (&of == &finding.shares.back() ? "." : ",");
  return text;
}

std::string StatusSentence(const ScenarioFindings& findings) {
  std::string text = Plural(findings.cells, "cell");
  for (std::size_t i = 0; i < findings.statuses.size(); ++i) {
    const auto& [status, count] = findings.statuses[i];
    text += fmt::format("{}{} {}", i == 0 ? ": " : ", ", FormatCount(count), StatusName(status));
  }
  if (findings.doubtful > 0) text += fmt::format("; doubtful: {}", FormatCount(findings.doubtful));
  return text;
}

std::string MissingReasons(const RunData& run, const std::string& scenario, const std::vector<SweptValue>& condition,
                           const std::string& method, const std::string& metric) {
  ReasonCounts counts;
  for (const Row* row : RowsUnder(run, scenario, condition)) {
    if (row->method != method) continue;
    const auto found = std::ranges::find(row->result.metrics, metric, &MetricValue::id);
    if (found == row->result.metrics.end()) {
      counts.Add(row->result.reason, fmt::format("{}: ", StatusName(row->result.status)));
    } else if (!found->value) {
      counts.Add(found->null_reason);
    }
  }
  std::string text;
  for (const CountedReason& one : counts.MostFrequentFirst()) {
    text += fmt::format("{}{} × {}", text.empty() ? "" : "; ", one.cells, one.Words());
  }
  return text;
}

Table FiguresTable(const KeyFigures& figures, bool has_number_columns) {
  Table table{.columns = {{.is_row_head = true}}};
  for (const std::string& label : figures.labels) {
    table.columns.push_back({.head = label, .is_number = has_number_columns});
  }
  for (const KeyFigures::Method& method : figures.methods) {
    table.rows.push_back({{method.name}});
    for (const std::string& value : method.values) table.rows.back().cells.emplace_back(value);
  }
  return table;
}

}  // namespace etude
