#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"
#include "bench/model/summary.h"

namespace etude {

/// An answer whose verdict has become worse. An answer compares a method with the baseline that the scenario names.
struct FallenAnswer {
  std::string scenario, condition;  ///< the condition as a CompactLabel
  std::string method, baseline;
  Verdict before = Verdict::kInconclusive, after = Verdict::kInconclusive;  ///< verdicts on each snapshot's worlds

  /// Returns true if "better" became "worse". Only this is a regression: near a practical threshold, a tiny change
  /// turns "better" into "no difference".
  bool Flips() const { return before == Verdict::kBetter && after == Verdict::kWorse; }
};

/// Returns the answers that fell from "better" to "no difference" or "worse", or from "no difference" to "worse". An
/// answer may fall although neither method moved by a practical threshold: one became a little worse, the other a
/// little better. An answer that is inconclusive in either snapshot has not fallen.
std::vector<FallenAnswer> FindFallenAnswers(const FinishedRun& run, const Snapshot& before, const Snapshot& after,
                                            std::span<const MetricMove> moves);

/// Describes a fallen answer: "ik-weights, joint_noise_deg=5: adaptive against fixed: better before, now worse".
std::string DescribeFallen(const FallenAnswer& one);

}  // namespace etude
