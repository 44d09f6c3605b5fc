#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// A verdict's words, or "it depends" when there are several.
inline std::string_view VerdictWords(const std::optional<Verdict>& verdict) {
  return verdict ? VerdictName(*verdict) : "it depends";
}

/// One method against its baseline, over all conditions, by one metric.
struct MethodFinding {
  std::string method;
  std::string baseline;
  std::optional<Verdict> verdict;  ///< empty when it depends on the condition
  std::string sentence;            ///< plain words with the figures that carry them

  std::string_view Words() const { return VerdictWords(verdict); }
};

/// How many cells ended in one way for one reason.
struct ReasonCount {
  Status status;
  std::string method;
  std::string reason;
  int cells = 0;
};

/// What is to be said of one scenario, in words; the page and the Markdown say the same.
struct ScenarioFindings {
  std::string metric;  ///< the first headline metric, which the answer is about; "" without any
  MethodFinding answer;
  std::vector<MethodFinding> methods;  ///< every method compared with another, in the scenario's order
  std::vector<std::string> yardsticks;
  int cells = 0;
  std::vector<std::pair<Status, int>> statuses;  ///< in the order of Status; those that occur
  std::vector<ReasonCount> reasons;              ///< of every cell that is not ok, most frequent first
};
ScenarioFindings FindingsOf(const RunData& run, const ScenarioSummary& scenario);

/// The whole run in one sentence, and the counts that it speaks of.
struct RunFindings {
  int cells = 0, ok = 0;
  int unsolved = 0;  ///< ended in order, without reaching the goal
  int skipped = 0;   ///< the world lacked what the task needs
  int broken = 0;    ///< failed, crashed, out of time or of bad output
  int met = 0, unmet = 0, undecided = 0;
  std::string sentence;
};
RunFindings FindingsOf(const RunData& run);

/// "480 cells: 470 ok, 8 unsolved, 2 failed"
std::string StatusSentence(const ScenarioFindings& findings);

/// Why values of this metric are missing in these cells: "2 × no effector seen; 1 × timeout".
std::string MissingReasons(const RunData& run, const std::string& scenario, const std::vector<SweptValue>& condition,
                           const std::string& method, const std::string& metric);

/// The summary of a metric, or null when the method has none of that name.
const MetricSummary* FindSummary(const MethodSummary& method, const std::string& metric);

}  // namespace etude
