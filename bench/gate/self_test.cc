#include "bench/gate/self_test.h"

#include <algorithm>
#include <array>

#include "bench/gate/comparison.h"
#include "bench/gate/gate.h"
#include "bench/gate/injected_tails.h"
#include "bench/statistics/proportion.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr std::array kSizes = {1.0, 2.0, 4.0};  // practical thresholds
constexpr double kSpread = 3;                   // practical thresholds, standard deviation over the worlds

/// A count of what happened, until all is counted.
struct Tally {
  int count = 0, of = 0;
  void Add(bool happened) {
    count += happened;
    ++of;
  }
  Rate Result() const {
    if (of == 0) return {};
    const Interval interval = WilsonInterval(count, of);
    return {count, of, interval.low, interval.high};
  }
};

bool Alarms(const SnapshotComparison& comparison) {
  return std::any_of(comparison.moves.begin(), comparison.moves.end(), IsRegression);
}

/// What a gate must know of `method` alone, under the name of the first one.
Snapshot InPlaceOfTheFirst(Snapshot snapshot, const std::string& method) {
  for (SnapshotScenario& scenario : snapshot.scenarios) {
    const std::string first = scenario.methods.front().first;
    std::erase_if(scenario.cells, [&](const SnapshotCells& cells) { return cells.method != method; });
    for (SnapshotCells& cells : scenario.cells) cells.method = first;
    scenario.methods = {{first, ""}};
  }
  return snapshot;
}

/// The first list of values that a difference can be put into; null when there is none.
SnapshotValues* FindTarget(Snapshot& snapshot) {
  for (SnapshotValues& values : snapshot.scenarios.front().cells.front().metrics) {
    const MetricInfo& metric = *FindMetric(values.metric);
    if (metric.direction != Direction::kNeither && metric.aggregate == Aggregate::kMedian) return &values;
  }
  return nullptr;
}

void Inject(SnapshotValues& values, double size, std::uint64_t seed) {
  const MetricInfo& metric = *FindMetric(values.metric);
  const double worse = metric.direction == Direction::kLowerIsBetter ? metric.practical : -metric.practical;
  RandomStream dice({.suite_seed = seed, .scenario = "gate-self-test", .trial = 0}, "injected");
  for (auto& value : values.values) {
    if (value) *value += worse * dice.Normal(size, kSpread);
  }
}

}  // namespace

bool SelfTestReport::Holds() const {
  return rerun_alarms.count + tail_rerun_alarms.count == 0 && tails_found && false_alarms.low <= kFalseAlarmLimit;
}

Result<SelfTestReport> RunSelfTest(const RunUnderSeed& run, int repetitions) {
  SelfTestReport report;
  Tally reruns, tail_reruns, gates, comparisons;
  InjectedTails tails;
  std::array<Tally, kSizes.size()> injected;
  std::vector<Tally> real;
  std::string target;
  NamedDigests methods;
  for (int i = 1; i <= repetitions; ++i) {
    const auto first_seed = static_cast<std::uint64_t>(2 * i - 1);
    const auto first_run = run(first_seed), same_run = run(first_seed), other_run = run(first_seed + 1);
    for (const auto* one : {&first_run, &same_run, &other_run}) {
      if (!*one) return tl::unexpected(one->error());
    }
    const Snapshot first = TakeSnapshot(*first_run);
    const std::string& name = first.scenarios.front().name;
    const TailRules rules = TailRulesOf(*first_run), no_tails = {{name, TailRule{.worlds = 0, .lost = 0}}};
    reruns.Add(Alarms(CompareSnapshots(first, TakeSnapshot(*same_run), {name})));

    tail_reruns.Add(Alarms(CompareSnapshots(first, TakeSnapshot(*same_run), {}, rules)));

    const SnapshotComparison nothing_changed = CompareSnapshots(first, TakeSnapshot(*other_run), {}, no_tails);
    gates.Add(Alarms(nothing_changed));
    for (const MetricMove& move : nothing_changed.moves) comparisons.Add(IsRegression(move));
    report.comparisons = static_cast<int>(nothing_changed.moves.size());

    for (std::size_t k = 0; k < kSizes.size(); ++k) {
      Snapshot worse = first;
      SnapshotValues* values = FindTarget(worse);
      if (values == nullptr) return Fail({}, "no gated metric is a median with a direction; name one (gate: metrics)");
      target = values->metric;
      Inject(*values, kSizes[k], first_seed);
      injected[k].Add(Alarms(CompareSnapshots(first, worse, {}, no_tails)));
    }
    tails.Try(first, target, first_seed, rules.at(name));

    methods = first.scenarios.front().methods;
    real.resize(methods.size());
    const Snapshot before = InPlaceOfTheFirst(first, methods.front().first);
    for (std::size_t m = 1; m < methods.size(); ++m) {
      real[m].Add(Alarms(CompareSnapshots(before, InPlaceOfTheFirst(first, methods[m].first), {}, no_tails)));
    }
  }
  report.rerun_alarms = reruns.Result();
  report.tail_rerun_alarms = tail_reruns.Result();
  report.tails = tails.Results();
  report.tails_found = tails.AsTheRuleSays();
  report.false_alarms = gates.Result();
  report.false_alarm_comparisons = comparisons.Result();
  for (std::size_t k = 0; k < kSizes.size(); ++k) {
    report.injected.push_back({fmt::format("{} worse by {} × what matters", target, kSizes[k]), injected[k].Result()});
  }
  for (std::size_t m = 1; m < methods.size(); ++m) {
    report.real.push_back(
        {fmt::format("{} in place of {}", methods[m].first, methods.front().first), real[m].Result()});
  }
  return report;
}

}  // namespace etude
