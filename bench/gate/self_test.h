#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/gate/comparison.h"
#include "bench/gate/finished_run.h"
#include "bench/gate/metric_move.h"

namespace etude {

/// A number of events among `of` cases, with the 95 % Wilson interval of its share.
struct Rate {
  int count = 0;
  int of = 0;
  double low = 0, high = 1;
};

/// The rate at which gates found one injected change.
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
  bool tails_found = true;  ///< true: the tail rule alarmed exactly when it had to
};

/// The largest allowed share of gates that report a regression although nothing changed: the alpha of Holm's
/// correction.
constexpr double kFalseAlarmLimit = 0.05;

using RunUnderSeed = std::function<Result<FinishedRun>(std::uint64_t seed)>;

/// Measures the gate on `repetitions` pairs of seeds (2i − 1, 2i):
/// - false alarms: trial t of one seed against trial t of the other. Both have the same distribution, so the sign of
///   every difference is random and every alarm is false. The differences are far larger than in a real gate, because
///   the worlds differ; the test is the same. The tail rule, which requires equal worlds, is off.
/// - reruns: the first seed against a second run of it.
/// - injected: the first seed against itself, with a random difference added to every value of one metric, in the
///   first method and condition. The metric is the first gated one that is a median and has a direction. The
///   differences are normal: mean k practical thresholds (worse), standard deviation three thresholds.
/// - tails: the first seed against itself, with a few worlds of that metric changed (InjectedTails).
/// - real: the first seed's first method against each other method in its place.
/// Fails if a run fails, or if the scenario has no metric for injection.
Result<SelfTestReport> RunSelfTest(const RunUnderSeed& run, int repetitions);

/// Makes a few worlds of a snapshot far worse, and counts the gates that find the change: a gate must find it exactly
/// if the tail rule counts it as a regression.
class InjectedTails {
 public:
  /// Changes the metric `target` of the first scenario and cells in copies of `first`, one change a copy:
  /// - n worlds become worse by 2 × `rule.times`; n = 1, 2, 3, 5, 10 and the smallest number that is a regression;
  /// - that smallest number of worlds becomes worse by 0.9 × `rule.times`;
  /// - one value is lost.
  /// `seed` keys the choice of worlds.
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
