#pragma once

#include <set>
#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"

namespace etude {

/// The comparison of two snapshots. It lists every entry of either snapshot, including entries that only one of them
/// has.
struct SnapshotComparison {
  /// The change of each metric that both snapshots have, even if no value changed.
  std::vector<MetricMove> moves;
  /// Entries that only one of the two snapshots contains, e.g. "ik-weights, joint_noise_deg=5, fixed, iterations".
  std::vector<std::string> only_before, only_after;
  std::vector<std::string> settings_changed;  ///< methods with the same name but different settings
};

/// Returns the reasons why the worlds of two snapshots cannot be paired: different seeds, numbers of trials, parameters
/// of the task, clips, or versions of a metric. Empty if the worlds can be paired.
std::vector<std::string> WhyNotComparable(const Snapshot& before, const Snapshot& after);

/// Removes from both snapshots the scenarios that cannot be compared, and returns the reasons (WhyNotComparable).
std::vector<std::string> DropIncomparable(Snapshot& before, Snapshot& after);

/// Compares two snapshots world by world, and judges each difference with JudgeMoves, then with JudgeTail. `exact`
/// names the scenarios in which no value may differ. A world in which a cell timed out, crashed or ran out of memory is
/// left out. Precondition: WhyNotComparable returns no reason.
SnapshotComparison CompareSnapshots(const Snapshot& before, const Snapshot& after, const std::set<std::string>& exact,
                                    const TailRules& tails = {});

}  // namespace etude
