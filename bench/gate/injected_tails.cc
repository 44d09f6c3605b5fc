#include "bench/gate/injected_tails.h"

#include <algorithm>
#include <set>

#include "bench/gate/comparison.h"
#include "bench/gate/gate.h"
#include "bench/statistics/proportion.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr double kFarBeyond = 2, kShort = 0.9;  // times what the rule lets pass

template <typename AnySnapshot>
auto& TargetOf(AnySnapshot& snapshot, const std::string& metric) {
  return *std::ranges::find(snapshot.scenarios.front().cells.front().metrics, metric, &SnapshotValues::metric);
}

/// `count` different trials that have a value, in the order drawn; fewer where there are no more.
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
  std::set<int> counts = {1, 2, 3, 5, 10};
  if (needed > 0) counts.insert(needed);
  for (const int count : counts) {
    if (count > present) break;
    Count(fmt::format("{} in {} of {} worlds worse by {} × what matters", target, count, present,
                      kFarBeyond * rule.times),
          needed > 0 && count >= needed, compare(static_cast<std::size_t>(count), worse_by(kFarBeyond)));
  }
  if (needed > 0 && needed <= present) {
    Count(fmt::format("{} in {} of {} worlds worse by {} × what matters", target, needed, present, kShort * rule.times),
          false, compare(static_cast<std::size_t>(needed), worse_by(kShort)));
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
