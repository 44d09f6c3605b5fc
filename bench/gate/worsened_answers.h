#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"
#include "bench/model/summary.h"

namespace etude {

/// An answer (method against the scenario's baseline method) whose verdict is worse than in the baseline snapshot.
struct WorsenedAnswer {
  std::string scenario, condition;  ///< the condition as a CompactLabel
  std::string method, baseline;
  Verdict before = Verdict::kUndecided, after = Verdict::kUndecided;  ///< verdict on the worlds of each snapshot

  /// Returns true if the verdict changed from "better" to "worse". Only such a change is a regression: near a practical
  /// threshold, a tiny change of the values turns "better" into "no difference".
  bool IsReversed() const { return before == Verdict::kBetter && after == Verdict::kWorse; }
};

/// Returns the answers whose verdict fell from "better" to "no difference" or "worse", or from "no difference" to
/// "worse". An answer may fall although neither method's values moved by a practical threshold: the method became a
/// little worse, and its baseline method a little better. An answer that is undecided in either snapshot has not
/// worsened.
std::vector<WorsenedAnswer> FindWorsenedAnswers(const FinishedRun& run, const Snapshot& before, const Snapshot& after,
                                                std::span<const MetricMove> moves);

/// Describes a worsened answer: "ik-weights, joint_noise_deg=5: adaptive against fixed: better before, now worse".
std::string DescribeWorsened(const WorsenedAnswer& one);

}  // namespace etude
