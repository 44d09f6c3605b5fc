#pragma once

#include <set>
#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"

namespace etude {

/// The comparison of two snapshots; everything in either is listed.
struct SnapshotComparison {
  std::vector<MetricMove> moves;                     ///< everything in both, also without a change
  std::vector<std::string> only_before, only_after;  ///< "ik-weights, joint_noise_deg=5, fixed, iterations"
  std::vector<std::string> settings_changed;         ///< methods with the same name and other settings
};

/// Returns why the worlds of two snapshots differ, so that they cannot be paired: another seed, number of trials,
/// parameters of the task, clips, or version of a metric. Empty = they can be compared.
std::vector<std::string> WhyNotComparable(const Snapshot& before, const Snapshot& after);

/// Removes the scenarios that WhyNotComparable complains of from both snapshots, and returns its reasons.
std::vector<std::string> DropIncomparable(Snapshot& before, Snapshot& after);

/// Compares world by world and judges (JudgeMoves; `exact` names the scenarios in which nothing may differ; then
/// JudgeTail). Worlds in which either cell ended because of the machine are left out. WhyNotComparable must be empty.
SnapshotComparison CompareSnapshots(const Snapshot& before, const Snapshot& after, const std::set<std::string>& exact,
                                    const TailRules& tails = {});

}  // namespace etude
