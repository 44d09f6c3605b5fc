#pragma once

#include <fmt/core.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/model/reasons.h"
#include "bench/model/run_data.h"
#include "io/drawing/table.h"
#include "reports/words/judged.h"

namespace etude {

/// Returns the name of a verdict, or "it depends" if the conditions differ.
inline std::string_view VerdictWords(const std::optional<Verdict>& verdict) {
  return verdict ? VerdictName(*verdict) : "it depends";
}

/// The comparison of one method with another method by one metric, over all conditions.
struct MethodFinding {
  std::string method;
  /// The method on the other side. If the strongest other method differs by condition, it is the first condition's.
  std::string baseline;
  SamplingUnit unit = SamplingUnit::kWorld;
  bool is_compared = false;             ///< false if the method was not compared by this metric
  std::optional<Verdict> verdict = {};  ///< verdict on these worlds; empty if the verdict depends on the condition
  BeyondFinding beyond = {};            ///< verdicts for other units
  std::string others = {};              ///< all methods on the other side, over the conditions: “a” or “b”
  std::string sentence = {};            ///< plain words, with the figures behind the verdicts
  std::string why_open = {};            ///< the reason for an open verdict; set only if there is one condition

  /// Returns the verdict in words: "better on these clips".
  std::string Words() const { return fmt::format("{} on {}", VerdictWords(verdict), TheseUnits(unit)); }
  /// Returns both verdicts: "better on these clips, inconclusive for other clips".
  std::string BothVerdicts() const;
};

/// Key figures of the method in question, its baseline and the strongest other method.
struct KeyFigures {
  struct Method {
    std::string name;
    std::vector<std::string> values;  ///< one per label, with its unit; "" if the method has no such value
  };
  /// Names of the known figures: headline metric, success, processor time, worlds lost to the method.
  std::vector<std::string> labels;
  std::vector<Method> methods;  ///< the method in question first; empty if nothing is compared
};

/// Returns the figures as a table. Its columns are aligned as numbers if `has_number_columns`.
Table FiguresTable(const KeyFigures& figures, bool has_number_columns);

/// The cells of a method that ended with one status, for reasons of one kind, which are counted together.
struct ReasonCount : CountedReason {
  Status status = Status::kFailed;
  std::string method = {};
};

/// For each method, the share of cells that reached the task's goal according to one metric. Status `ok` only means
/// that a cell was measured.
struct SuccessFinding {
  std::string metric;
  std::vector<std::pair<std::string, double>> shares;  ///< per method: mean over its cells that have a value, 0…1
};

/// All findings on one scenario in words, which the page and the Markdown share.
struct ScenarioFindings {
  std::string metric;    ///< the first headline metric, which the question is about; "" if there is none
  std::string headline;  ///< the answer in one line: against the baseline, and against the strongest other method
  MethodFinding answer;  ///< the comparison with the baseline
  /// The comparison with the strongest other method. It is marked as not compared in old runs, and if no such method
  /// exists.
  MethodFinding rival;
  KeyFigures figures;
  std::vector<MethodFinding> methods;  ///< every method compared with another, in the scenario's order
  std::vector<std::string> yardsticks;
  int cells = 0;
  std::vector<std::pair<Status, int>> statuses;  ///< only statuses that occur, in the order of Status
  std::vector<SuccessFinding> successes;         ///< one per success metric (MetricInfo::is_success)
  std::vector<ReasonCount> reasons;              ///< reasons of all cells that are not ok, the most frequent first
};
/// Returns true if the strongest other method is not the baseline, so that the comparison with it adds something.
bool HasOtherRival(const ScenarioFindings& findings);

ScenarioFindings FindingsOf(const RunData& run, const ScenarioSummary& scenario);

/// The whole run in one sentence, and the counts in it.
struct RunFindings {
  int cells = 0;
  int ok = 0;        ///< measured; the status does not say whether a goal was reached
  int unsolved = 0;  ///< measured, but ended before the goal was reached
  int skipped = 0;   ///< not run, because the world lacked something that the task needs
  int broken = 0;    ///< failed, crashed, timed out or answered badly
  int met = 0, unmet = 0, undecided = 0;
  std::string sentence;
};
RunFindings FindingsOf(const RunData& run);

/// Returns a finding on success: "Reached (share “as smooth as nature”): fuzzy 0 %, natural 98.3 %." If there are many
/// methods, it names only those with the smallest and the largest share.
std::string SuccessSentence(const SuccessFinding& finding);

/// Returns the counts of the statuses: "480 cells: 470 ok, 8 unsolved, 2 failed".
std::string StatusSentence(const ScenarioFindings& findings);

/// Returns the reasons for missing values of a metric in one method's cells under one condition: "2 × no effector seen;
/// 1 × timeout".
std::string MissingReasons(const RunData& run, const std::string& scenario, const std::vector<SweptValue>& condition,
                           const std::string& method, const std::string& metric);

/// Returns the summary of a metric; null if the method has none.
const MetricSummary* FindSummary(const MethodSummary& method, const std::string& metric);

}  // namespace etude
