#pragma once

#include <set>
#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"

namespace etude {

/// Two snapshots side by side: nothing of either is left out.
struct SnapshotComparison {
  std::vector<MetricMove> moves;                     ///< all that is in both, also what did not move
  std::vector<std::string> only_before, only_after;  ///< "ik-weights, joint_noise_deg=5, fixed, iterations"
  std::vector<std::string> settings_changed;         ///< methods: same name, other settings
};

/// Explains why the worlds of two snapshots are not the same, so that nothing can be paired: another seed, number of
/// trials, parameters of the task, clips, or version of a metric. Empty = they can be compared.
std::vector<std::string> WhyNotComparable(const Snapshot& before, const Snapshot& after);

/// Takes the scenarios that WhyNotComparable complains of out of both snapshots, and gives its reasons.
std::vector<std::string> DropIncomparable(Snapshot& before, Snapshot& after);

/// Compares world by world and judges (JudgeMoves; `exact` names the scenarios in which nothing may differ; then
/// JudgeTail). Worlds where either cell ended because of the machine are left out. Requires that WhyNotComparable is
/// empty.
SnapshotComparison CompareSnapshots(const Snapshot& before, const Snapshot& after, const std::set<std::string>& exact,
                                    const TailRules& tails = {});

}  // namespace etude
