#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "bench/gate/finished_run.h"

namespace etude {

/// A rule about times, and what the run says about it.
struct RatioResult {
  std::string scenario;
  TimeRatio rule;
  int pairs = 0;  ///< worlds of all conditions in which both methods ended for reasons of their own
  std::optional<double> median, ci_low, ci_high;  ///< of processor time over processor time
  /// Unmet when the whole interval lies above the limit, for a busy machine moves single times; undecided when
  /// only the median does, or when too few worlds have both times.
  Ruling ruling = Ruling::kUndecided;
};

/// Judges the time rules of all scenarios. Both times of a pair come from the same world of the same run.
std::vector<RatioResult> JudgeTimeRatios(const FinishedRun& run);

enum class GateVerdict { kPassed, kRegressed, kNotWhole };

struct GateExpectation {
  std::string scenario;
  ExpectationResult result;
};

/// The findings of a gate, and how much it has looked at.
struct GateReport {
  std::string suite;
  std::string run_folder;        ///< as the caller names it, for `etude replay`; "" = not known
  std::string baseline_file;     ///< "" = no baseline: only what the scenarios themselves expect was judged
  std::string baseline_version;  ///< of the program that made it
  std::string program_version;   ///< of the program that made the run
  std::vector<GateExpectation> expectations;
  std::vector<RatioResult> ratios;
  SnapshotComparison comparison;
  std::vector<std::string> silent;      ///< methods that gave no answer in any cell, in words: they fail
  std::vector<std::string> incomplete;  ///< why there can be no verdict on the whole
  bool runs_programs = false;           ///< some methods are programs, which `etude replay` asks to be allowed
};

/// Judges a finished run by what its scenarios expect, by their time rules, and, when there is one, against a
/// baseline. Fails when the baseline's worlds are not the run's (WhyNotComparable).
Result<GateReport> JudgeRun(const FinishedRun& run, const Snapshot* baseline, const std::string& baseline_file);

/// The rules of a run's scenarios: what is compared digit by digit, and what is a regression of single worlds.
std::set<std::string> ExactScenarios(const FinishedRun& run);
TailRules TailRulesOf(const FinishedRun& run);

/// Returns why there can be no verdict on the whole: the run is not whole, cells ended in a status that depends on the
/// machine (timeout, crashed, out of memory; one sentence per scenario and status), or every cell was skipped.
std::vector<std::string> WhyIncomplete(const FinishedRun& run);

/// One sentence per method that gave no answer (ok or unsolved) in any of its cells, with the most frequent causes,
/// unless all of them were skipped.
std::vector<std::string> DescribeSilentMethods(const FinishedRun& run);

/// True if a move makes the gate fail.
bool IsRegression(const MetricMove& move);

/// Incomplete goes before regression: a run without all its cells is not judged, however bad the rest looks. What
/// moved is in the report all the same. What cannot be decided (an expectation, a time rule, a difference that is
/// unclear) is told, and passes.
GateVerdict GateVerdictOf(const GateReport& report);

}  // namespace etude
