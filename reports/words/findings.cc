#include "reports/words/findings.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "reports/words/answer.h"
#include "reports/words/figures.h"
#include "reports/words/yardstick.h"

namespace etude {
namespace {

bool SameCondition(const std::vector<SweptValue>& a, const std::vector<SweptValue>& b) {
  return std::ranges::equal(
      a, b, [](const SweptValue& x, const SweptValue& y) { return x.key == y.key && x.value == y.value; });
}

std::string ExpectationsSentence(const RunFindings& f) {
  const int all = f.met + f.unmet + f.undecided;
  if (all == 0) return "This run states no expectations.";
  std::string text;
  if (f.met == all) {
    text = all == 1 ? "The one expectation was met" : fmt::format("All {} expectations were met", all);
  } else {
    text = fmt::format("{} of {} were met", f.met, Plural(all, "expectation"));
    if (f.unmet > 0) text += fmt::format(", {} not", f.unmet);
    if (f.undecided > 0) text += fmt::format(", {} could not be decided", f.undecided);
  }
  return text + ".";
}

}  // namespace

const MetricSummary* FindSummary(const MethodSummary& method, const std::string& metric) {
  const auto found = std::ranges::find(method.metrics, metric, &MetricSummary::id);
  return found == method.metrics.end() ? nullptr : &*found;
}

ScenarioFindings FindingsOf(const RunData& run, const ScenarioSummary& scenario) {
  ScenarioFindings findings;
  if (!scenario.headline_metrics.empty()) findings.metric = scenario.headline_metrics.front();
  findings.answer = AnswerInWords(scenario, findings.metric);
  for (std::size_t i = 1; i < scenario.methods.size(); ++i) {
    if (IsYardstick(scenario, scenario.methods[i])) {
      findings.yardsticks.push_back(scenario.methods[i]);
    } else if (!IsComparedWithNone(scenario, scenario.methods[i])) {
      findings.methods.push_back(CompareInWords(scenario, scenario.methods[i], findings.metric));
    }
  }

  std::map<Status, int> statuses;
  std::map<std::tuple<Status, std::string, std::string>, int> reasons;
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    ++findings.cells;
    ++statuses[row.result.status];
    if (row.result.status != Status::kOk) ++reasons[{row.result.status, row.method, row.result.reason}];
  }
  findings.statuses.assign(statuses.begin(), statuses.end());
  for (const auto& [key, cells] : reasons) {
    findings.reasons.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), cells});
  }
  std::ranges::stable_sort(findings.reasons, std::ranges::greater{}, &ReasonCount::cells);
  return findings;
}

RunFindings FindingsOf(const RunData& run) {
  RunFindings f;
  for (const Row& row : run.rows) {
    ++f.cells;
    switch (row.result.status) {
      case Status::kOk:
        ++f.ok;
        break;
      case Status::kUnsolved:
        ++f.unsolved;
        break;
      case Status::kSkipped:
        ++f.skipped;
        break;
      default:
        ++f.broken;
    }
  }
  for (const ScenarioSummary& scenario : run.scenarios) {
    for (const ExpectationResult& expectation : scenario.expectations) {
      if (expectation.ruling == Ruling::kMet) ++f.met;
      if (expectation.ruling == Ruling::kUnmet) ++f.unmet;
      if (expectation.ruling == Ruling::kUndecided) ++f.undecided;
    }
  }
  f.sentence = ExpectationsSentence(f);
  if (f.cells == 0) {
    f.sentence += " No cell ran.";
  } else if (f.ok == f.cells) {
    f.sentence += fmt::format(" Every one of the {} ended well.", Plural(f.cells, "cell"));
  } else {
    f.sentence += fmt::format(" {} of {} reached their goal", FormatShare(f.ok, f.cells), Plural(f.cells, "cell"));
    if (f.unsolved > 0) f.sentence += fmt::format(", {} did not", FormatCount(f.unsolved));
    if (f.skipped > 0) f.sentence += fmt::format(", {} did not apply", FormatCount(f.skipped));
    f.sentence += f.broken > 0 ? fmt::format(", {} broke.", FormatCount(f.broken)) : ", none broke.";
  }
  return f;
}

std::string StatusSentence(const ScenarioFindings& findings) {
  std::string text = Plural(findings.cells, "cell");
  for (std::size_t i = 0; i < findings.statuses.size(); ++i) {
    const auto& [status, count] = findings.statuses[i];
    text += fmt::format("{}{} {}", i == 0 ? ": " : ", ", FormatCount(count), StatusName(status));
  }
  return text;
}

std::string MissingReasons(const RunData& run, const std::string& scenario, const std::vector<SweptValue>& condition,
                           const std::string& method, const std::string& metric) {
  std::map<std::string, int> counts;
  for (const Row& row : run.rows) {
    if (row.scenario != scenario || row.method != method || !SameCondition(row.condition, condition)) continue;
    const auto found = std::ranges::find(row.result.metrics, metric, &MetricValue::id);
    if (found == row.result.metrics.end()) {
      ++counts[fmt::format("{}: {}", StatusName(row.result.status), row.result.reason)];
    } else if (!found->value) {
      ++counts[found->null_reason];
    }
  }
  std::string text;
  for (const auto& [reason, count] : counts) text += fmt::format("{}{} × {}", text.empty() ? "" : "; ", count, reason);
  return text;
}

}  // namespace etude
