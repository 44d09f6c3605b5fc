#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"

namespace etude {

/// A count of something that happened, with the 95 % Wilson interval of its share.
struct Rate {
  int count = 0;
  int of = 0;
  double low = 0, high = 1;
};

/// The share of made changes that a gate found.
struct PowerResult {
  std::string change;
  Rate found;
};

/// The figures of a gate that has tested itself.
struct SelfTestReport {
  int comparisons = 0;                ///< of one gate
  Rate rerun_alarms;                  ///< gates by the rule `exact` between two runs of one seed: must be none
  Rate tail_rerun_alarms;             ///< gates by the tail rule between them: must be none
  Rate false_alarms;                  ///< gates between runs of two seeds that cry regression
  Rate false_alarm_comparisons;       ///< of all comparisons of these gates
  std::vector<PowerResult> injected;  ///< changes of known size, put into one metric of one method
  std::vector<PowerResult> tails;     ///< a few worlds made far worse, or losing their value, in the same metric
  std::vector<PowerResult> real;      ///< the first method replaced by each other one

  /// True if the gate keeps its promise: reruns never alarm, false alarms are not clearly above kFalseAlarmLimit, and
  /// the tail rule finds as many far worse worlds as it counts.
  bool Holds() const;
  bool tails_found = true;  ///< every gate in which the tail rule had to fail did, and no other
};

/// The share of gates that may cry regression although nothing changed: alpha of the comparisons' Holm correction.
constexpr double kFalseAlarmLimit = 0.05;

/// Makes a whole run of one and the same scenario under a seed.
using RunUnderSeed = std::function<Result<FinishedRun>(std::uint64_t seed)>;

/// Measures the gate on `repetitions` pairs of seeds (2i − 1, 2i):
///  - false alarms: trial t of the one seed against trial t of the other. Both are drawn alike, so the sign of every
///    difference is a coin's throw: whatever the gate cries is false. The worlds differ, which makes the differences
///    far larger than those of a real gate, but nothing else about the test. The tail rule, which is about the same
///    worlds, is off.
///  - reruns: the first seed against itself, run again.
///  - injected: the first seed against itself, with a difference added to the values of the first method, first
///    condition, in the first gated metric that is a median and has a direction: k times its practical threshold for
///    the worse, in every world another one (normal, standard deviation of three thresholds).
///  - tails: the first seed against itself, with n worlds of that metric made worse by twice what the scenario's tail
///    rule lets pass, n = 1 up to what it counts; and with one value lost.
///  - real: the first seed's worlds, in which another method takes the first one's place.
/// Fails when a run does, or when the scenario has no metric to inject into.
Result<SelfTestReport> RunSelfTest(const RunUnderSeed& run, int repetitions);

/// Makes few worlds of a snapshot far worse, and counts in how many gates that is found: every one in which the tail
/// rule says so, and no other by this rule.
class InjectedTails {
 public:
  /// Changes `target` (scenario 0, cells 0, this metric) of copies of `first`: n worlds worse by twice the rule's
  /// `times`, n = 1, 2, 3, 5, 10 and as many as fail by the rule; that many by nine tenths of it; one value lost.
  /// `seed` keys which worlds.
  void Try(const Snapshot& first, const std::string& target, std::uint64_t seed, const TailRule& rule);

  std::vector<PowerResult> Results() const;
  /// True if all gates did as the rule says.
  bool AsTheRuleSays() const { return as_the_rule_says_; }

 private:
  struct Case {
    std::string change;
    int found = 0, of = 0;
  };
  void Count(const std::string& change, bool must_be_found, const SnapshotComparison& comparison);

  std::vector<Case> cases_;
  bool as_the_rule_says_ = true;
};

}  // namespace etude
