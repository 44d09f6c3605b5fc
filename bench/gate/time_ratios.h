#pragma once

#include <optional>
#include <string>
#include <vector>

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

}  // namespace etude
