#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"
#include "bench/model/summary.h"

namespace etude {

/// An answer (a method against the one that the scenario names) that was decided, and is now decided for less.
struct FallenAnswer {
  std::string scenario, condition;  ///< CompactLabel
  std::string method, baseline;
  Verdict before = Verdict::kInconclusive, after = Verdict::kInconclusive;  ///< on these worlds

  /// Returns true if the answer is now the opposite. Only this is a regression: between "better" and "no difference" a
  /// difference at the edge of what matters may move by next to nothing.
  bool Flips() const { return before == Verdict::kBetter && after == Verdict::kWorse; }
};

/// Returns the answers that fell from "better" to "no difference" or "worse", or from "no difference" to "worse". They
/// may fall although no method moved by as much as matters: the method a little down, the other a little up. An answer
/// that is undecided in either snapshot has not fallen.
///
/// Both snapshots are judged by the same rules, those of `run`, from the values that they keep. A scenario is left out
/// if none of its `moves` differs, or if success, a headline metric or its weight is not kept. WhyNotComparable must be
/// empty.
std::vector<FallenAnswer> FindFallenAnswers(const FinishedRun& run, const Snapshot& before, const Snapshot& after,
                                            std::span<const MetricMove> moves);

/// "ik-weights, joint_noise_deg=5: adaptive against fixed: better before, now worse"
std::string DescribeFallen(const FallenAnswer& one);

}  // namespace etude
