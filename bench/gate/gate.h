#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "bench/gate/finished_run.h"

namespace etude {

/// A rule about times, and its result.
struct RatioResult {
  std::string scenario;
  TimeRatio rule;
  int pairs = 0;  ///< worlds of all conditions in which neither method was ended by the machine
  std::optional<double> median, ci_low, ci_high;  ///< of the ratios of processor times
  /// Unmet if the whole interval lies above the limit, because single times vary on a busy machine; undecided if only
  /// the median does, or if too few worlds have both times.
  ClaimOutcome ruling = ClaimOutcome::kUndecided;
};

/// Judges the time rules of all scenarios. Both times of a pair come from the same world of the same run.
std::vector<RatioResult> JudgeTimeRatios(const FinishedRun& run);

enum class GateVerdict { kPassed, kRegressed, kNotWhole };

struct GateExpectation {
  std::string scenario;
  ExpectationResult result;
};

/// The findings of a gate, with the numbers of things checked.
struct GateReport {
  std::string suite;
  std::string run_folder;        ///< as the caller names it, for `etude replay`; "" = unknown
  std::string baseline_file;     ///< "" = no baseline: only the scenarios' own expectations were judged
  std::string baseline_version;  ///< of the program that made the baseline
  std::string program_version;   ///< of the program that made the run
  std::vector<GateExpectation> expectations;
  std::vector<RatioResult> ratios;
  SnapshotComparison comparison;
  std::vector<std::string> silent;      ///< methods without an answer in any cell, in words: they fail the gate
  std::vector<std::string> incomplete;  ///< why there is no verdict on the whole
  bool runs_programs = false;           ///< some methods are programs, for which `etude replay` needs permission
};

/// Judges a finished run by its scenarios' expectations, by their time rules, and against a baseline if there is one.
/// Fails if the baseline's worlds are not the run's (WhyNotComparable).
Result<GateReport> JudgeRun(const FinishedRun& run, const Snapshot* baseline, const std::string& baseline_file);

/// Return the rules of a run's scenarios: which are compared exactly, and when single worlds are a regression.
std::set<std::string> ExactScenarios(const FinishedRun& run);
TailRules TailRulesOf(const FinishedRun& run);

/// Returns why there is no verdict on the whole: the run is incomplete, cells ended in a status that depends on the
/// machine (timeout, crashed, out of memory; one sentence per scenario and status), or every cell was skipped.
std::vector<std::string> WhyIncomplete(const FinishedRun& run);

/// Returns one sentence per method without an answer (ok or unsolved) in any of its cells, with the most frequent
/// causes, unless all of its cells were skipped.
std::vector<std::string> DescribeSilentMethods(const FinishedRun& run);

/// Returns true if a move makes the gate fail.
bool IsRegression(const MetricMove& move);

/// Returns the verdict. "Incomplete" comes before "regressed": a run without all its cells is not judged, however bad
/// the rest is; the report still lists what moved. Whatever cannot be decided (an expectation, a time rule, an unclear
/// difference) is reported and passes.
GateVerdict GateVerdictOf(const GateReport& report);

}  // namespace etude
