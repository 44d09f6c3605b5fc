#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/summary.h"

namespace etude {

/// The other side of a comparison: the baseline that the scenario names, or the strongest other method.
enum class Against { kBaseline, kRival };

struct Judged {
  const Comparison* comparison;
  const ConditionSummary* condition;
  /// The answer that the comparison decides or belongs to; null if the comparison stands alone.
  const Answer* answer = nullptr;

  /// These functions return the verdict on these worlds and the verdict for other units like them.
  Verdict Here() const { return answer == nullptr ? comparison->verdict : answer->verdict; }
  std::optional<Verdict> Elsewhere() const { return answer == nullptr ? comparison->beyond.verdict : answer->beyond; }
};

/// Returns the comparisons of `method` by `metric`, one per condition, in their order. Summaries written by old
/// versions contain no comparisons with a rival.
std::vector<Judged> JudgedOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// Returns the answers on a method, one per condition. Each answer comes with the comparison that decides it: of
/// success, or else of the value. If the summary has no answers, returns the comparisons by the first headline metric.
std::vector<Judged> AnswersOf(const ScenarioSummary& scenario, const std::string& method, Against against);

/// Returns true if all comparisons are by the same metric.
bool HaveOneMetric(const std::vector<Judged>& judged);

/// Returns the methods that a comparison's baseline names: two if it is "a or b" (bench/statistics/scenario_table.h),
/// else one.
std::vector<std::string> BaselinesOf(const Judged& judged);

/// Names the methods on the other side: "“a”", or "“a” or “b”" if conditions or halves of the worlds have different
/// rivals.
std::string OthersOf(const std::vector<Judged>& judged);

/// Returns the verdict on these worlds if it is the same for all `judged`, else nothing. `judged` must not be empty.
std::optional<Verdict> CommonVerdict(const std::vector<Judged>& judged);

/// Returns "both conditions", "all 4 conditions".
std::string AllConditions(std::size_t count);

/// Counts verdicts in words: "better under 3 of 4, inconclusive under 1 of 4", "worse under all 4 conditions"; "" for
/// no verdicts.
std::string CountVerdicts(const std::vector<Verdict>& verdicts, std::size_t conditions);

/// Returns the verdict on these worlds of each of `judged`.
std::vector<Verdict> VerdictsOf(const std::vector<Judged>& judged);

/// Returns true if a method is compared with no other one (its `against` names itself). Returns false for the first
/// method, because it is the baseline of the others.
bool IsComparedWithNone(const ScenarioSummary& scenario, const std::string& method);

/// Returns true for a yardstick, such as natural motion: a method that is not compared with any other method in either
/// direction.
bool IsYardstick(const ScenarioSummary& scenario, const std::string& method);

/// Returns the method's index in the scenario, which selects its colour and mark; the number of methods if it is not
/// found.
std::size_t IndexOf(const ScenarioSummary& scenario, const std::string& method);

/// Returns the name of a method, with a mark if it is a yardstick: "natural (yardstick)".
std::string MethodLabel(const ScenarioSummary& scenario, const std::string& method);

/// Returns the units of a verdict on the worlds that were run: "these worlds", "these people", "these clips".
std::string_view TheseUnits(SamplingUnit unit);
/// Returns the words for other units of the same kind: "other worlds", "other people", "other clips".
std::string_view OtherUnits(SamplingUnit unit);

/// The verdicts of comparisons for other units, summarised over all conditions.
struct BeyondFinding {
  bool on_these_only = true;            ///< no condition has a verdict for other units
  bool as_on_these = false;             ///< every condition has a verdict for other units, as on these worlds
  std::optional<Verdict> verdict = {};  ///< the verdict for other units, if all conditions that have one agree
  std::string words = {};               ///< "for other clips: worse", "on these clips only (4 clips, 6 are needed)"
};
BeyondFinding BeyondInWords(const std::vector<Judged>& judged, SamplingUnit unit);

/// Returns the finding of one comparison, short enough for a table's cell or an XML attribute.
std::string ShortBeyond(const Comparison& comparison, SamplingUnit unit);

}  // namespace etude
