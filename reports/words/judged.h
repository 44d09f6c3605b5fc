#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/summary.h"

namespace etude {

/// The method with which a method is compared: the baseline that the scenario names, or the strongest other method.
enum class Against { kBaseline, kRival };

struct Judged {
  const Comparison* comparison;
  const ConditionSummary* condition;
  /// The answer to which the comparison belongs; the answer's verdicts replace the comparison's verdicts. Null if there
  /// is no answer.
  const Answer* answer = nullptr;

  /// `Here()` returns the verdict on the worlds of this run. `Elsewhere()` returns the verdict generalised to other
  /// clips, people or libraries; nullopt if the run has too few of these.
  Verdict Here() const { return answer == nullptr ? comparison->verdict : answer->verdict; }
  std::optional<Verdict> Elsewhere() const { return answer == nullptr ? comparison->beyond.verdict : answer->beyond; }
};

/// Returns the comparisons of `method` by `metric`, one per condition, in the conditions' order. Summaries written by
/// old versions contain no comparisons with the strongest other method.
std::vector<Judged> JudgedOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// Returns the answers about a method, one per condition. Each answer comes with one comparison. If success decided
/// the answer, or if no world has values of both methods, this is the comparison by success; otherwise it is the
/// comparison by the value metric. If a table shows the same comparison, the table's entry is returned: its interval
/// comes from other random numbers and may differ a little. If the summary has no answers, returns the comparisons by
/// the first headline metric.
std::vector<Judged> AnswersOf(const ScenarioSummary& scenario, const std::string& method, Against against);

/// Returns the answers about a method if `metric` is the scenario's first headline metric, which its question is about;
/// else returns the method's comparisons by `metric`.
std::vector<Judged> QuestionOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                               Against against);

/// If success decided an answer, returns the comparisons of the value that the question is about; else nothing.
std::vector<Judged> ValuesBeside(const ScenarioSummary& scenario, const std::vector<Judged>& judged, Against against);

/// Returns true if the far better and far worse worlds (the tail) decided the answer.
bool IsDecidedByTail(const Judged& judged);

/// Returns true if the mean difference lies outside the interval of the median difference. The sentence about the
/// comparison then also states the mean.
bool MeanTellsMore(const Comparison& c);

/// Returns the answer of a condition that the tail of this comparison's metric decided; null if there is none.
const Answer* FindTailAnswer(const ConditionSummary& condition, const Comparison& comparison);

/// Returns the comparison as tables show it. If the tail of its metric decided the answer of `condition`, the result
/// has the answer's verdicts and a reason that says so, because a table must not contradict the answer.
Comparison AsAnswered(const ConditionSummary& condition, const Comparison& comparison);

/// Returns the numbers of worlds by which a tail decided an answer: "far worse in 23 of 120 worlds, far better in 3".
std::string TailInWords(const Answer& answer);

/// Returns true if all these comparisons are by the same metric.
bool HaveOneMetric(const std::vector<Judged>& judged);

/// Returns the names in a comparison's baseline: two names if the baseline is "a or b" (two methods, each the strongest
/// on half of the worlds; see bench/statistics/scenario_table.h), else one name.
std::vector<std::string> BaselinesOf(const Judged& judged);

/// Names the methods with which a method is compared: "“a”", or "“a” or “b”" if the strongest other method differs
/// between conditions or halves of the worlds.
std::string OthersOf(const std::vector<Judged>& judged);

/// Returns the verdict on the worlds of this run if it is the same in all of `judged`, else nullopt. `judged` must not
/// be empty.
std::optional<Verdict> CommonVerdict(const std::vector<Judged>& judged);

/// Returns the words for a number of conditions: "both conditions", "all 4 conditions".
std::string AllConditions(std::size_t count);

/// Counts equal verdicts in words: "better under 3 of 4, undecided under 1 of 4", "worse under all 4 conditions"; ""
/// for no verdicts.
std::string CountVerdicts(const std::vector<Verdict>& verdicts, std::size_t conditions);

/// Returns the verdict of each entry of `judged` on the worlds of this run.
std::vector<Verdict> VerdictsOf(const std::vector<Judged>& judged);

/// Returns true if a method is compared with no other method (its key `against` names the method itself). Returns false
/// for the first method, because other methods are compared with the first method.
bool IsComparedWithNone(const ScenarioSummary& scenario, const std::string& method);

/// Returns true for a yardstick, such as natural motion: a method that is compared with no other method, and no other
/// method is compared with it.
bool IsYardstick(const ScenarioSummary& scenario, const std::string& method);

/// Returns the method's index in the scenario, which selects its colour and mark; the number of methods if the method
/// is not found.
std::size_t IndexOf(const ScenarioSummary& scenario, const std::string& method);

/// Returns the name of a method, with a mark if it is a yardstick: "natural (yardstick)".
std::string MethodLabel(const ScenarioSummary& scenario, const std::string& method);

/// Returns the name of the sampling units of this run: "these worlds", "these people", "these clips".
std::string_view TheseUnits(SamplingUnit unit);
/// Returns the name of sampling units that were not run, to which a verdict generalises: "other worlds", "other
/// people", "other clips".
std::string_view OtherUnits(SamplingUnit unit);

/// The verdicts generalised to sampling units that were not run (other clips, people or libraries), summarised over all
/// conditions.
struct BeyondFinding {
  bool on_these_only = true;  ///< true: no condition has a generalised verdict
  /// True: every condition has a generalised verdict that equals the verdict on the run's worlds.
  bool as_on_these = false;
  std::optional<Verdict> verdict = {};  ///< the generalised verdict; nullopt if there is none, or if conditions differ
  std::string words = {};               ///< "for other clips: worse", "on these clips only (4 clips, 6 are needed)"
};
BeyondFinding BeyondInWords(const std::vector<Judged>& judged, SamplingUnit unit);

/// Returns the generalised verdict of one comparison in words, short enough for a table cell or an XML attribute.
std::string ShortBeyond(const Comparison& comparison, SamplingUnit unit);

}  // namespace etude
