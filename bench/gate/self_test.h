#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"

namespace etude {

/// The number of positive cases among `of` cases, with the 95 % Wilson interval of their share.
struct Rate {
  int count = 0;
  int of = 0;
  double low = 0, high = 1;
};

/// The statistical power of the gate: the share of gates that found one kind of injected change.
struct PowerResult {
  std::string change;
  Rate found;
};

struct SelfTestReport {
  int comparisons = 0;  ///< number of comparisons that one gate makes
  /// Rate at which the rule `exact` reports a regression between two runs of one seed; must be zero.
  Rate rerun_alarms;
  /// Rate at which the tail rule reports a regression between two runs of one seed; must be zero.
  Rate tail_rerun_alarms;
  /// Rate of gates that report a regression although the methods are the same and only the seeds differ.
  Rate false_alarms;
  Rate false_alarm_comparisons;       ///< share of regressions among all comparisons in the gates of `false_alarms`
  std::vector<PowerResult> injected;  ///< power for random differences of known mean, added to one metric of one method
  /// Power for a few worlds that become far worse or lose a value, in the metric of `injected`.
  std::vector<PowerResult> tails;
  /// Power for another method in place of the scenario's first one; one entry for each method but the first.
  std::vector<PowerResult> real;

  /// Returns true if the gate works as specified: it never reports a regression between two runs of one seed, the
  /// interval of the false alarms does not lie above kFalseAlarmLimit, and the tail rule finds exactly the changes that
  /// it must find.
  bool Holds() const;
  bool tails_found = true;  ///< true: the tail rule reported a regression if and only if it had to
};

/// The largest allowed share of gates that report a regression although nothing changed: the significance level of
/// Holm's correction.
constexpr double kFalseAlarmLimit = 0.05;

using RunUnderSeed = std::function<Result<FinishedRun>(std::uint64_t seed)>;

/// Measures the gate on `repetitions` pairs of seeds (2i − 1, 2i):
/// - false alarms: compares trial t of one seed with trial t of the other. Both trials' values have the same
///   distribution, so the sign of every difference is random, and every reported regression is false. The differences
///   are far larger than in a real gate, because the worlds differ; the test is the same. The tail rule, which requires
///   equal worlds, is off.
/// - reruns: compares two runs of the first seed.
/// - injected: compares the run of the first seed with three copies of this run. In each copy, random differences are
///   added to the values of one metric of the first method under the first condition. The metric is the first compared
///   metric that is aggregated by the median and has a direction. The differences have a normal distribution. Their
///   mean makes the values worse by one, two or four practical thresholds; their standard deviation is three
///   thresholds. The tail rule is off.
/// - tails: compares the run of the first seed with copies in which the metric of `injected` is changed in a few
///   worlds (InjectedTails).
/// - real: in the run of the first seed, compares the first method with each other method as if this were a new
///   version of the first. The tail rule is off.
/// Fails if a run fails, or if the scenario has no metric for injection.
Result<SelfTestReport> RunSelfTest(const RunUnderSeed& run, int repetitions);

/// Makes a few worlds of a snapshot far worse, and counts the gates that find the change: a gate must find it if and
/// only if the tail rule counts it as a regression.
class InjectedTails {
 public:
  /// Makes copies of `first`. Each copy has one change, to the values of metric `target` in the first cells of the
  /// first scenario. Let N be the smallest number of far worse worlds that `rule` counts as a regression.
  /// - n worlds become worse by 2 × `rule.times` practical thresholds, for n = 1, 2, 3, 5, 10 and N;
  /// - N worlds become worse by 0.9 × `rule.times` practical thresholds;
  /// - one value is lost.
  /// `seed` determines which worlds are chosen.
  void Try(const Snapshot& first, const std::string& target, std::uint64_t seed, const TailRule& rule);

  std::vector<PowerResult> Results() const;
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
