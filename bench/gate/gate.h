#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "bench/gate/fallen_answers.h"
#include "bench/gate/finished_run.h"

namespace etude {

struct RatioResult {
  std::string scenario;
  TimeRatio rule;
  int pairs = 0;  ///< worlds of all conditions in which neither method timed out, crashed or ran out of memory
  std::optional<double> median, ci_low, ci_high;  ///< median of the ratios of processor times, and its interval
  /// Unmet if the whole confidence interval lies above the limit. Undecided if only the median lies above it (times
  /// vary on a busy machine), or if too few worlds have both times. Otherwise met.
  ClaimOutcome outcome = ClaimOutcome::kUndecided;
};

/// Judges the time rules of all scenarios. Each ratio compares two methods in the same world of the same run.
std::vector<RatioResult> JudgeTimeRatios(const FinishedRun& run);

enum class GateVerdict { kPassed, kRegressed, kIncomplete };

struct GateExpectation {
  std::string scenario;
  ExpectationResult result;
};

/// The answer that the run itself gives about a method (summary.json). The report shows it next to the moves.
struct GateAnswer {
  std::string scenario, condition;
  Answer answer;
};

struct GateReport {
  std::string suite;
  std::string run_folder;        ///< as the caller names it, for `etude replay`; "" = unknown
  std::string baseline_file;     ///< "" = no baseline: only the scenarios' own expectations were judged
  std::string baseline_version;  ///< the version of the program that made the baseline
  std::string program_version;   ///< the version of the program that made the run
  std::vector<GateExpectation> expectations;
  std::vector<GateAnswer> answers;  ///< comparisons with baselines; of these, only `fallen` affects the verdict
  std::vector<RatioResult> ratios;
  SnapshotComparison comparison;
  std::vector<FallenAnswer> fallen;     ///< answers with a worse verdict than before; one that flips fails the gate
  std::vector<std::string> silent;      ///< a sentence per method without any answer: each fails the gate
  std::vector<std::string> incomplete;  ///< why there is no verdict
  bool runs_programs = false;           ///< true: some methods are programs, so `etude replay` needs permission
};

/// Judges a finished run by its scenarios' expectations and time rules, and by comparison with a baseline if there is
/// one (nullptr = none). Fails if the baseline's worlds differ from the run's (WhyNotComparable).
Result<GateReport> JudgeRun(const FinishedRun& run, const Snapshot* baseline, const std::string& baseline_file);

std::set<std::string> ExactScenarios(const FinishedRun& run);
TailRules TailRulesOf(const FinishedRun& run);

/// Returns the reasons why there is no verdict: the run is incomplete, every cell was skipped, or the machine ended
/// cells. For the last reason there is one sentence per scenario and status (timeout, crashed, out of memory).
std::vector<std::string> WhyIncomplete(const FinishedRun& run);

/// Returns one sentence for each method that has no answer (status ok or unsolved) in any cell. The sentence gives the
/// most frequent causes. A method whose cells were all skipped is left out.
std::vector<std::string> DescribeSilentMethods(const FinishedRun& run);

/// Returns true if a move makes the gate fail.
bool IsRegression(const MetricMove& move);

/// Returns the verdict. A run with missing cells is incomplete, not regressed, however bad its other cells are; the
/// report still lists the moves. An undecided expectation, time rule or difference passes.
GateVerdict GateVerdictOf(const GateReport& report);

}  // namespace etude
