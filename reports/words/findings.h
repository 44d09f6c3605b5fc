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

/// Returns the name of a verdict; "differs by condition" if the verdict differs between conditions (nullopt).
inline std::string_view VerdictWords(const std::optional<Verdict>& verdict) {
  return verdict ? VerdictName(*verdict) : "differs by condition";
}

/// The comparison of `method` with another method by one metric, over all conditions.
struct MethodFinding {
  std::string method;
  /// The other method of the comparison. If the strongest other method differs between conditions, this is the
  /// strongest other method of the first condition.
  std::string baseline;
  SamplingUnit unit = SamplingUnit::kWorld;
  bool is_compared = false;             ///< false if the method was not compared by this metric
  std::optional<Verdict> verdict = {};  ///< verdict on the run's worlds; nullopt if it differs between conditions
  BeyondFinding beyond = {};            ///< verdicts generalised to other clips, people or libraries
  std::string others = {};  ///< the names of all methods with which `method` is compared, as a text: “a” or “b”
  /// States the comparison in words, with the numbers behind the verdicts and, under one condition, the reason if it is
  /// undecided.
  std::string sentence = {};

  /// Returns the verdict in words: "better on these clips".
  std::string Words() const { return fmt::format("{} on {}", VerdictWords(verdict), TheseUnits(unit)); }
  /// Returns both verdicts: "better on these clips, undecided for other clips".
  std::string BothVerdicts() const;
};

/// Key numbers of the method in question, its baseline and the strongest other method.
struct KeyFigures {
  struct Method {
    std::string name;
    std::vector<std::string> values;  ///< one value per label, with a unit; "" if the method has no such value
  };
  /// Names of the key numbers that are known: headline metric, success, processor time, worlds in which a method
  /// loses to the method in question.
  std::vector<std::string> labels;
  std::vector<Method> methods;  ///< the method in question first; empty if nothing is compared
};

/// Returns the key numbers as a table. The table's columns are aligned as numbers if `has_number_columns`.
Table FiguresTable(const KeyFigures& figures, bool has_number_columns);

/// Counts the cells of one method that ended in one status for the same kind of reason.
struct ReasonCount : CountedReason {
  Status status = Status::kFailed;
  std::string method = {};
};

/// Counts the cells of one method of a scenario that have no answer (HasAnswer), for one status and kind of reason.
struct FailureCount : ReasonCount {
  std::string scenario = {};
  int of = 0;  ///< the number of cells of the method that were not skipped, under all conditions
};

/// For each method, the share of cells that reached the task's goal according to one metric. Status `ok` only means
/// that a cell was measured.
struct SuccessFinding {
  std::string metric;
  /// For each method, the mean of the success metric over the cells that have a value, 0…1.
  std::vector<std::pair<std::string, double>> shares;
};

/// All findings about one scenario in words. The page and the Markdown text show the same findings.
struct ScenarioFindings {
  std::string metric;  ///< the first headline metric, which the question is about; "" if there is none
  /// The scenario's answer in one line: the method in question against the baseline, and against the strongest other
  /// method.
  std::string headline;
  MethodFinding answer;  ///< comparison of the method in question with its baseline
  /// Comparison of the method in question with the strongest other method. If there is no other method, and for runs of
  /// old versions, `rival.is_compared` is false.
  MethodFinding rival;
  KeyFigures figures;
  /// One finding for every method that is compared with another method, in the scenario's order.
  std::vector<MethodFinding> methods;
  std::vector<std::string> yardsticks;
  int cells = 0;
  std::vector<std::pair<Status, int>> statuses;  ///< number of cells in each status that occurs, in the order of Status
  std::vector<SuccessFinding> successes;         ///< one finding per success metric (MetricInfo::is_success)
  std::vector<ReasonCount> reasons;  ///< reasons, WithoutDoubts, of all cells that are not ok, the most frequent first
  std::vector<ReasonCount> doubts;   ///< doubts about the files of cells (DoubtsIn), as kOk, the most frequent first
  int doubtful = 0;                  ///< number of cells with doubts
};
/// Returns a line about a reason or a doubt: how many cells have it, of which method.
std::string DescribeCount(const ReasonCount& reason);
/// Returns the failures of a run in the order of its scenarios, the most frequent first. Skipped cells do not count.
std::vector<FailureCount> FailuresOf(const RunData& run);
/// Returns a line about failures: "crashed: 2 of 6 cells of mine in ik: ended with signal 11".
std::string DescribeFailure(const FailureCount& failure);
/// Returns true if the strongest other method is not the baseline. Otherwise, a comparison with the strongest other
/// method adds no information.
bool HasOtherRival(const ScenarioFindings& findings);

ScenarioFindings FindingsOf(const RunData& run, const ScenarioSummary& scenario);

/// A sentence about the whole run, and the numbers of cells that the sentence states.
struct RunFindings {
  int cells = 0;
  int ok = 0;        ///< measured cells; their status does not say whether they reached a goal
  int unsolved = 0;  ///< cells that were measured, but ended before they reached the goal
  int unanswered = 0;  ///< cells whose program answered `no_answer`
  int skipped = 0;   ///< cells that were not run, because their world lacked something for the task
  int broken = 0;    ///< cells that failed, crashed, timed out or gave an invalid answer
  int met = 0, unmet = 0, undecided = 0;
  std::string sentence;
};
RunFindings FindingsOf(const RunData& run);

/// Returns a sentence about success: "Reached (share “as smooth as nature”): fuzzy 0 %, natural 98.3 %." If there are
/// many methods, names only the methods with the smallest and the largest share.
std::string SuccessSentence(const SuccessFinding& finding);

/// Returns how many cells ended in each status: "480 cells: 470 ok, 8 unsolved, 2 failed".
std::string StatusSentence(const ScenarioFindings& findings);

/// Returns the reasons why values of a metric are missing in one method's cells under one condition: "2 × no effector
/// seen; 1 × timeout".
std::string MissingReasons(const RunData& run, const std::string& scenario, const std::vector<SweptValue>& condition,
                           const std::string& method, const std::string& metric);

/// Returns the summary of a metric; null if the method has none.
const MetricSummary* FindSummary(const MethodSummary& method, const std::string& metric);

/// Returns the headline metrics, and after them the success metrics in which a method's mean is below 100 %, such as
/// the share judged. A table without them would hide what a method left out.
std::vector<std::string> TableMetrics(const ScenarioSummary& scenario);

}  // namespace etude
