#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"

namespace etude {

/// A count of events, with the 95 % Wilson interval of its share.
struct Rate {
  int count = 0;
  int of = 0;
  double low = 0, high = 1;
};

/// How often gates found one injected change.
struct PowerResult {
  std::string change;
  Rate found;
};

struct SelfTestReport {
  int comparisons = 0;                ///< number of comparisons of one gate
  Rate rerun_alarms;                  ///< alarms of the rule `exact` between two runs of one seed: must be zero
  Rate tail_rerun_alarms;             ///< alarms of the tail rule between two runs of one seed: must be zero
  Rate false_alarms;                  ///< gates that alarm although they compare two seeds of the same methods
  Rate false_alarm_comparisons;       ///< comparisons that alarm in these gates
  std::vector<PowerResult> injected;  ///< changes of known size, injected into one metric of one method
  std::vector<PowerResult> tails;     ///< a few worlds of the same metric made far worse, or with their value removed
  std::vector<PowerResult> real;      ///< the first method replaced by each other method

  /// Returns true if the gate works as specified: reruns never alarm, the interval of false alarms does not lie above
  /// kFalseAlarmLimit, and the tail rule finds exactly what it must find.
  bool Holds() const;
  bool tails_found = true;  ///< the tail rule alarmed exactly when it had to
};

/// The share of gates that may report a regression although nothing changed: alpha of Holm's correction.
constexpr double kFalseAlarmLimit = 0.05;

using RunUnderSeed = std::function<Result<FinishedRun>(std::uint64_t seed)>;

/// Measures the gate on `repetitions` pairs of seeds (2i − 1, 2i):
/// - false alarms: trial t of one seed against trial t of the other. Both have the same distribution, so the sign of
///   every difference is random and every alarm is false. The differences are far larger than in a real gate, because
///   the worlds differ; the test is the same. The tail rule, which requires equal worlds, is off.
/// - reruns: the first seed against a second run of it.
/// - injected: the first seed against itself, with a random difference added to every value of one metric, for the
///   first method and condition: the first gated metric that is a median and has a direction. The differences are
///   normal: mean k practical thresholds (worse), standard deviation three thresholds.
/// - tails: the first seed against itself, with n worlds of that metric made worse by twice what the scenario's tail
///   rule allows, n from 1 to the number that is a regression; and with one value lost.
/// - real: the first seed's first method against each other method in its place.
/// Fails if a run does, or if the scenario has no metric for injection.
Result<SelfTestReport> RunSelfTest(const RunUnderSeed& run, int repetitions);

/// Makes a few worlds of a snapshot far worse, and counts the gates that find the change: a gate must find it exactly
/// if the tail rule counts it as a regression.
class InjectedTails {
 public:
  /// Changes `target` (scenario 0, cells 0, this metric) in copies of `first`: n worlds worse by twice the rule's
  /// `times`, n = 1, 2, 3, 5, 10 and the number that is a regression; that number worse by nine tenths of `times`; one
  /// value lost. `seed` keys the choice of worlds.
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
