#include "bench/gate/self_test.h"

#include <algorithm>
#include <array>
#include <set>

#include "bench/gate/gate.h"
#include "bench/statistics/interval.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr std::array kSizes = {1.0, 2.0, 4.0};  // means of injected differences, in practical thresholds
constexpr double kDeviation = 3;                // standard deviation of injected differences, in practical thresholds

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

/// Returns a copy of the snapshot that has only the cells of `method`, renamed to the first method.
Snapshot WithMethodAsFirst(Snapshot snapshot, const std::string& method) {
  for (SnapshotScenario& scenario : snapshot.scenarios) {
    const std::string first = scenario.methods.front().first;
    std::erase_if(scenario.cells, [&](const SnapshotCells& cells) { return cells.method != method; });
    for (SnapshotCells& cells : scenario.cells) cells.method = first;
    scenario.methods = {{first, ""}};
  }
  return snapshot;
}

/// Finds the values into which differences can be injected: the values of the first metric that has a direction and is
/// aggregated by the median. Returns null if there is no such metric.
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
    if (value) *value += worse * dice.Normal(size, kDeviation);
  }
}

// Two amounts by which a world is made worse, as multiples of the tail rule's `times`: the gate must find the first and
// not the second.
constexpr double kBeyondRule = 2, kWithinRule = 0.9;

template <typename AnySnapshot>
auto& TargetOf(AnySnapshot& snapshot, const std::string& metric) {
  return *std::ranges::find(snapshot.scenarios.front().cells.front().metrics, metric, &SnapshotValues::metric);
}

/// Draws `count` different trials that have a value, at random. Returns fewer if there are not enough.
std::vector<std::size_t> DrawTrials(const SnapshotValues& values, std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> trials;
  for (std::size_t t = 0; t < values.values.size(); ++t) {
    if (values.values[t]) trials.push_back(t);
  }
  RandomStream dice({.suite_seed = seed, .scenario = "gate-self-test", .trial = 0}, "tail");
  for (std::size_t i = 0; i < trials.size(); ++i) std::swap(trials[i], trials[i + dice.IndexBelow(trials.size() - i)]);
  trials.resize(std::min(count, trials.size()));
  return trials;
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
    // Compare two runs of one seed: neither the exact rule nor the tail rule may report a regression.
    reruns.Add(Alarms(CompareSnapshots(first, TakeSnapshot(*same_run), {name})));

    tail_reruns.Add(Alarms(CompareSnapshots(first, TakeSnapshot(*same_run), {}, rules)));

    // Count false alarms: compare runs of two seeds, with the tail rule off.
    const SnapshotComparison nothing_changed = CompareSnapshots(first, TakeSnapshot(*other_run), {}, no_tails);
    gates.Add(Alarms(nothing_changed));
    for (const MetricMove& move : nothing_changed.moves) comparisons.Add(IsRegression(move));
    report.comparisons = static_cast<int>(nothing_changed.moves.size());

    // Add random differences of known mean to one metric. Then make a few worlds far worse.
    for (std::size_t k = 0; k < kSizes.size(); ++k) {
      Snapshot worse = first;
      SnapshotValues* values = FindTarget(worse);
      if (values == nullptr)
        return Fail({},
                    "the self-test needs a metric that has a direction and is aggregated by its median; add such a "
                    "metric to the list 'metrics' of the key 'gate'");
      target = values->metric;
      Inject(*values, kSizes[k], first_seed);
      injected[k].Add(Alarms(CompareSnapshots(first, worse, {}, no_tails)));
    }
    tails.Try(first, target, first_seed, rules.at(name));

    // Replace the first method by each other method, and count the gates that report a regression.
    methods = first.scenarios.front().methods;
    real.resize(methods.size());
    const Snapshot before = WithMethodAsFirst(first, methods.front().first);
    for (std::size_t m = 1; m < methods.size(); ++m) {
      real[m].Add(Alarms(CompareSnapshots(before, WithMethodAsFirst(first, methods[m].first), {}, no_tails)));
    }
  }
  // Report the rates.
  report.rerun_alarms = reruns.Result();
  report.tail_rerun_alarms = tail_reruns.Result();
  report.tails = tails.Results();
  report.tails_found = tails.AsTheRuleSays();
  report.false_alarms = gates.Result();
  report.false_alarm_comparisons = comparisons.Result();
  for (std::size_t k = 0; k < kSizes.size(); ++k) {
    report.injected.push_back(
        {fmt::format("{} worse by {} × the difference that matters", target, kSizes[k]), injected[k].Result()});
  }
  for (std::size_t m = 1; m < methods.size(); ++m) {
    report.real.push_back(
        {fmt::format("{} in place of {}", methods[m].first, methods.front().first), real[m].Result()});
  }
  return report;
}

void InjectedTails::Try(const Snapshot& first, const std::string& target, std::uint64_t seed, const TailRule& rule) {
  const MetricInfo& metric = *FindMetric(target);
  const double worse = (metric.direction == Direction::kLowerIsBetter ? 1 : -1) * metric.practical * rule.times;
  const auto compare = [&](std::size_t count, auto change) {
    Snapshot after = first;
    SnapshotValues& values = TargetOf(after, target);
    for (const std::size_t trial : DrawTrials(values, count, seed)) change(values.values[trial]);
    return CompareSnapshots(first, after, {}, {{first.scenarios.front().name, rule}});
  };
  const auto worse_by = [&](double times) { return [=](std::optional<double>& value) { *value += times * worse; }; };
  const auto present = static_cast<int>(DrawTrials(TargetOf(first, target), SIZE_MAX, seed).size());
  const int needed = WorldsThatFail(present, rule);
  // Make `count` worlds worse by 2 × `rule.times` practical thresholds. The gate must report a regression if and only
  // if `count` is at least `needed`, the smallest number that is a regression by the tail rule.
  std::set<int> counts = {1, 2, 3, 5, 10};
  if (needed > 0) counts.insert(needed);
  for (const int count : counts) {
    if (count > present) break;
    Count(fmt::format("{} worse in {} of {} worlds by {} × the difference that matters", target, count, present,
                      kBeyondRule * rule.times),
          needed > 0 && count >= needed, compare(static_cast<std::size_t>(count), worse_by(kBeyondRule)));
  }
  // Make worlds worse by 0.9 × `rule.times` practical thresholds, which the gate must not report. Then remove a value,
  // which the gate must report if `rule.lost` is 1.
  if (needed > 0 && needed <= present) {
    Count(fmt::format("{} worse in {} of {} worlds by {} × the difference that matters", target, needed, present,
                      kWithinRule * rule.times),
          false, compare(static_cast<std::size_t>(needed), worse_by(kWithinRule)));
  }
  if (present > 0) {
    Count(fmt::format("{} lost in 1 of {} worlds", target, present), rule.lost == 1,
          compare(1, [](std::optional<double>& value) { value = std::nullopt; }));
  }
}

void InjectedTails::Count(const std::string& change, bool must_be_found, const SnapshotComparison& comparison) {
  const bool found = std::ranges::any_of(comparison.moves, IsRegression);
  const bool by_tail = std::ranges::any_of(comparison.moves, &MetricMove::by_tail);
  if (must_be_found ? !found : by_tail) as_the_rule_says_ = false;
  auto place = std::ranges::find(cases_, change, &Case::change);
  if (place == cases_.end()) place = cases_.insert(cases_.end(), Case{change});
  place->found += found;
  ++place->of;
}

std::vector<PowerResult> InjectedTails::Results() const {
  std::vector<PowerResult> results;
  for (const Case& one : cases_) {
    const Interval interval = WilsonInterval(one.found, one.of);
    results.push_back({one.change, {one.found, one.of, interval.low, interval.high}});
  }
  return results;
}

}  // namespace etude
