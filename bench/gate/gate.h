#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "bench/gate/finished_run.h"
#include "bench/gate/worsened_answers.h"
#include "bench/model/judged_time.h"

namespace etude {

/// A time ratio. It is met only if the median time of `over` is at least kMinJudgedSeconds, and unmet only if that of
/// `of` is.
struct RatioResult {
  std::string scenario;
  TimeRatio rule;
  /// Number of worlds, over all conditions, in which both methods have a processor time. A cell has none if it timed
  /// out, crashed, ran out of memory, or took less time than the clock can resolve.
  int pairs = 0;
  /// Median over worlds of the ratio of processor times, `rule.of` / `rule.over`, and the median's 95 % interval.
  std::optional<double> median, ci_low, ci_high;
  /// Unmet if the whole interval of the ratio is above the limit. Undecided if only the median is above the limit
  /// (times vary on a busy machine), if too few worlds have the times of both methods, or if a method's times are too
  /// short to judge. Otherwise met.
  ClaimOutcome outcome = ClaimOutcome::kUndecided;
  /// The median time that decides (kMinJudgedSeconds), if it is too short.
  std::optional<double> too_short_s = {};
};

/// Judges the rules on processor times of all scenarios. Each ratio compares two methods in the same world of the same
/// run.
std::vector<RatioResult> JudgeTimeRatios(const FinishedRun& run);

enum class GateVerdict { kPassed, kRegressed, kIncomplete };

struct GateExpectation {
  std::string scenario;
  ExpectationResult result;
};

/// A verdict on a method, from the run's own summary.json. The report shows it next to the changes since the baseline.
struct GateAnswer {
  std::string scenario, condition;
  Answer answer;
};

struct GateReport {
  std::string suite;
  std::string run_folder;        ///< the folder's name as the caller gave it, for `etude replay`; "" = unknown
  std::string baseline_file;     ///< file of the baseline; "" = none: only the scenarios' own expectations were judged
  std::string baseline_version;  ///< the version of the program that made the baseline
  std::string program_version;   ///< the version of the program that made the run
  std::vector<GateExpectation> expectations;
  /// The run's verdicts on methods against their baseline methods, for the report. They do not affect the gate's
  /// verdict by themselves; only changes since the baseline do (`worsened`).
  std::vector<GateAnswer> answers;
  std::vector<RatioResult> ratios;
  SnapshotComparison comparison;
  /// Answers whose verdict became worse. Only a change from "better" to "worse" makes the gate fail
  /// (WorsenedAnswer::IsReversed).
  std::vector<WorsenedAnswer> worsened;
  /// One sentence for each method without any answer, and for each own metric without any value (DescribeSilent). Each
  /// of them makes the gate fail.
  std::vector<std::string> silent;
  std::vector<std::string> incomplete;  ///< the reasons why the gate gives no verdict
  std::vector<std::string> doubts;      ///< what looks wrong in judged files; for the report only
  /// True: some methods are outside programs, so `etude replay` needs permission to run them.
  bool runs_programs = false;
};

/// Judges a finished run by its scenarios' expectations and rules on processor times, and by comparison with a baseline
/// unless `baseline` is null. Fails if the baseline's worlds differ from the run's (WhyNotComparable).
Result<GateReport> JudgeRun(const FinishedRun& run, const Snapshot* baseline, const std::string& baseline_file);

std::set<std::string> ExactScenarios(const FinishedRun& run);
TailRules TailRulesOf(const FinishedRun& run);

/// Returns the reasons why the gate gives no verdict: the run is incomplete, every cell was skipped, or cells ended
/// because of the machine. For the last reason there is one sentence per scenario and status (timeout, crashed, out of
/// memory).
std::vector<std::string> WhyIncomplete(const FinishedRun& run);

/// Returns one sentence for each method that has no answer (status ok or unsolved) in any cell, and for each metric of
/// the user's own (AddedMetrics) that the gate judges and that has no value in any cell with an answer. The sentence
/// gives the most frequent reasons. A method whose cells were all skipped is left out.
std::vector<std::string> DescribeSilent(const FinishedRun& run);

/// Returns true if the change of this metric makes the gate fail.
bool IsRegression(const MetricMove& move);

/// Returns the verdict of the gate. If `report.incomplete` is not empty, the verdict is kIncomplete, however bad the
/// results are. The report then lists the changes since the baseline, but not if rows are missing or the run did not
/// end (JudgeRun). An expectation, a rule on processor times or a change that is undecided does not make the gate
/// fail.
GateVerdict GateVerdictOf(const GateReport& report);

}  // namespace etude
