#pragma once

#include <fmt/core.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/model/run_data.h"
#include "io/drawing/table.h"
#include "reports/words/judged.h"

namespace etude {

/// Gives a verdict's words, or "it depends" when there are several.
inline std::string_view VerdictWords(const std::optional<Verdict>& verdict) {
  return verdict ? VerdictName(*verdict) : "it depends";
}

/// The finding on one method against another, over all conditions, by one metric.
struct MethodFinding {
  std::string method;
  std::string baseline;  ///< whom it was compared with; the strongest other one may be another under each condition
  SamplingUnit unit = SamplingUnit::kWorld;
  bool is_compared = false;             ///< by this metric at all
  std::optional<Verdict> verdict = {};  ///< on these worlds; empty when it depends on the condition
  BeyondFinding beyond = {};            ///< for others like them
  std::string others = {};              ///< all whom it was compared with: “a” or “b”
  std::string sentence = {};            ///< plain words with the figures that carry the verdicts
  std::string why_open = {};            ///< why nothing is decided, where that can be said of one condition

  /// Writes the verdict in words: "better on these clips".
  std::string Words() const { return fmt::format("{} on {}", VerdictWords(verdict), TheseUnits(unit)); }
  /// Writes both verdicts: "better on these clips, inconclusive for other clips".
  std::string BothVerdicts() const;
};

/// The method in question beside its baseline and the strongest other one: a few figures of each.
struct KeyFigures {
  struct Method {
    std::string name;
    std::vector<std::string> values;  ///< one per label, with its unit; "" where it has no meaning
  };
  std::vector<std::string> labels;  ///< headline metric, success, processor time, worlds lost; what is known
  std::vector<Method> methods;      ///< the one in question first; empty where nothing is compared
};

/// Writes the figures as a table: in columns of numbers, where the place that it stands in does not align them itself.
Table FiguresTable(const KeyFigures& figures, bool has_number_columns);

/// The count of cells that ended in one way for one reason.
struct ReasonCount {
  Status status;
  std::string method;
  std::string reason;
  int cells = 0;
};

/// The finding on how far the methods reached what their task is about, by one metric. Status ok says only that a cell
/// was measured.
struct SuccessFinding {
  std::string metric;
  std::vector<std::pair<std::string, double>> shares;  ///< by method: mean over all its cells that have a value, 0…1
};

/// All findings on one scenario, in words; the page and the Markdown say the same.
struct ScenarioFindings {
  std::string metric;    ///< the first headline metric, which the answer is about; "" without any
  std::string headline;  ///< the answer in one line: against the baseline, and against the strongest other method
  MethodFinding answer;  ///< against the baseline
  MethodFinding rival;   ///< against the strongest other method; not compared in older runs, or where there is none
  KeyFigures figures;
  std::vector<MethodFinding> methods;  ///< every method compared with another, in the scenario's order
  std::vector<std::string> yardsticks;
  int cells = 0;
  std::vector<std::pair<Status, int>> statuses;  ///< in the order of Status; those that occur
  std::vector<SuccessFinding> successes;         ///< by every metric that tells success (MetricInfo::is_success)
  std::vector<ReasonCount> reasons;              ///< of every cell that is not ok, most frequent first
};
/// Is true where the strongest other method is another one than the baseline, so that there is more to tell.
bool HasOtherRival(const ScenarioFindings& findings);

ScenarioFindings FindingsOf(const RunData& run, const ScenarioSummary& scenario);

/// The whole run in one sentence, and the counts that it speaks of.
struct RunFindings {
  int cells = 0;
  int ok = 0;        ///< measured; whether anything was reached is no matter of status
  int unsolved = 0;  ///< measured too, known to have stopped short of the goal
  int skipped = 0;   ///< the world lacked what the task needs
  int broken = 0;    ///< failed, crashed, out of time or of bad output
  int met = 0, unmet = 0, undecided = 0;
  std::string sentence;
};
RunFindings FindingsOf(const RunData& run);

/// Writes a finding on success: "Reached (share “as smooth as nature”): fuzzy 0 %, natural 98.3 %."; of many methods
/// the least and the most.
std::string SuccessSentence(const SuccessFinding& finding);

/// Counts the statuses: "480 cells: 470 ok, 8 unsolved, 2 failed".
std::string StatusSentence(const ScenarioFindings& findings);

/// Says why values of this metric are missing in these cells: "2 × no effector seen; 1 × timeout".
std::string MissingReasons(const RunData& run, const std::string& scenario, const std::vector<SweptValue>& condition,
                           const std::string& method, const std::string& metric);

/// Finds the summary of a metric; null when the method has none of that name.
const MetricSummary* FindSummary(const MethodSummary& method, const std::string& metric);

}  // namespace etude
