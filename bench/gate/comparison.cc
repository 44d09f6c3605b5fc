#include "bench/gate/comparison.h"

#include <algorithm>
#include <map>

#include "bench/statistics/judged_alike.h"

namespace etude {
namespace {

std::string NameOf(const std::string& scenario, const SnapshotCells& cells) {
  return fmt::format("{}, {}, {}", scenario, cells.condition, cells.method);
}

template <typename Items, typename Matches>
auto FindIn(Items& items, Matches matches) -> decltype(&*items.begin()) {
  const auto found = std::find_if(items.begin(), items.end(), matches);
  return found == items.end() ? nullptr : &*found;
}

const SnapshotScenario* FindScenario(const Snapshot& snapshot, const std::string& name) {
  return FindIn(snapshot.scenarios, [&](const SnapshotScenario& scenario) { return scenario.name == name; });
}

const SnapshotCells* FindCells(const SnapshotScenario& scenario, const SnapshotCells& like) {
  return FindIn(scenario.cells, [&](const SnapshotCells& cells) {
    return cells.condition == like.condition && cells.method == like.method;
  });
}

const SnapshotValues* FindValues(const SnapshotCells& cells, const std::string& metric) {
  return FindIn(cells.metrics, [&](const SnapshotValues& values) { return values.metric == metric; });
}

/// Lists the scenarios, cells and metrics that `one` contains and `other` does not. If `other` lacks a whole scenario
/// or cell, only the name of that scenario or cell is listed.
std::vector<std::string> OnlyIn(const Snapshot& one, const Snapshot& other) {
  std::vector<std::string> only;
  for (const SnapshotScenario& scenario : one.scenarios) {
    const SnapshotScenario* partner = FindScenario(other, scenario.name);
    if (partner == nullptr) {
      only.push_back(scenario.name);
      continue;
    }
    for (const SnapshotCells& cells : scenario.cells) {
      const SnapshotCells* same = FindCells(*partner, cells);
      if (same == nullptr) only.push_back(NameOf(scenario.name, cells));
      for (const SnapshotValues& values : cells.metrics) {
        if (same == nullptr || FindValues(*same, values.metric) != nullptr) continue;
        only.push_back(NameOf(scenario.name, cells) + ", " + values.metric);
      }
    }
  }
  return only;
}

const std::string* FindDigest(const NamedDigests& digests, const std::string& name) {
  const auto* found = FindIn(digests, [&](const auto& pair) { return pair.first == name; });
  return found == nullptr ? nullptr : &found->second;
}

/// The trials of the worlds that exist in both snapshots of a scenario. Trial `before[i]` of the earlier snapshot and
/// trial `after[i]` of the later one are the same world.
struct SharedWorlds {
  std::vector<std::size_t> before, after;
};

/// Pairs the worlds of two snapshots. Worlds made of files form a pair if they have the same name and the same ground
/// truth; other worlds form a pair if they have the same trial. Files that only one snapshot has are added to the lists
/// of `comparison`.
SharedWorlds FindShared(const SnapshotScenario& before, const SnapshotScenario& after, SnapshotComparison& comparison) {
  SharedWorlds shared;
  // If the worlds are not made of files, pair equal trials.
  if (before.files.empty() || after.files.empty()) {
    for (int t = 0; t < std::min(before.trials, after.trials); ++t) {
      shared.before.push_back(static_cast<std::size_t>(t));
      shared.after.push_back(static_cast<std::size_t>(t));
    }
    return shared;
  }
  // If the worlds are made of files, pair worlds of the same name and ground truth. List the files of `before` that
  // have no pair, then those of `after`.
  std::map<std::string, std::size_t> trial_of;
  for (std::size_t t = 0; t < after.files.size(); ++t) trial_of[after.files[t].first] = t;
  for (std::size_t t = 0; t < before.files.size(); ++t) {
    const auto& [name, truth] = before.files[t];
    const auto found = trial_of.find(name);
    const bool is_same = found != trial_of.end() && after.files[found->second].second == truth;
    if (is_same) {
      shared.before.push_back(t);
      shared.after.push_back(found->second);
    } else {
      comparison.only_before.push_back(before.name + ", " + name + (found == trial_of.end() ? "" : ", its truth"));
    }
    if (is_same) trial_of.erase(found);
  }
  for (const auto& [name, truth] : after.files) {
    const auto left = trial_of.find(name);
    if (left == trial_of.end()) continue;
    const bool has_other = FindDigest(before.files, name) != nullptr;
    comparison.only_after.push_back(before.name + ", " + name + (has_other ? ", its truth" : ""));
  }
  return shared;
}

/// Returns the elements whose indices are in `places`.
template <typename Elements>
Elements Picked(const Elements& elements, const std::vector<std::size_t>& places) {
  Elements picked;
  for (const std::size_t place : places) picked.push_back(elements[place]);
  return picked;
}

/// Returns a copy of the cells that has only the statuses and values of the given trials.
SnapshotCells Picked(const SnapshotCells& cells, const std::vector<std::size_t>& trials) {
  SnapshotCells picked{cells.condition, cells.method, Picked(cells.statuses, trials), {}};
  if (!cells.judged.empty()) picked.judged = Picked(cells.judged, trials);
  for (const SnapshotValues& values : cells.metrics) {
    picked.metrics.push_back({values.metric, Picked(values.values, trials)});
  }
  return picked;
}

std::vector<bool> WorldsToCompare(const SnapshotCells& before, const SnapshotCells& after) {
  std::vector<bool> compared(std::min(before.statuses.size(), after.statuses.size()));
  for (std::size_t t = 0; t < compared.size(); ++t) {
    compared[t] = !DependsOnMachine(StatusOf(before.statuses[t])) && !DependsOnMachine(StatusOf(after.statuses[t]));
  }
  return compared;
}

int CountDiffering(const SnapshotCells& before, const SnapshotCells& after, const std::vector<bool>& compared) {
  int differing = 0;
  for (std::size_t t = 0; t < compared.size(); ++t) {
    differing += compared[t] && before.statuses[t] != after.statuses[t];
  }
  return differing;
}

/// Returns the column of the metric that weighs `metric` (MetricInfo::weight); null if there is none.
const std::vector<std::optional<double>>* WeightsOf(const SnapshotCells& cells, const MetricInfo& metric) {
  const SnapshotValues* weights = metric.weight.empty() ? nullptr : FindValues(cells, metric.weight);
  return weights == nullptr ? nullptr : &weights->values;
}

/// Returns why the values of a metric cannot be compared (WhyNotAlike); "" if they can.
std::string WhyNotAlike(const SnapshotValues& before, const SnapshotCells& cells, const SnapshotValues& after,
                        const SnapshotCells& others) {
  std::vector<JudgedPair> judged;
  const auto side = [&](const JudgedOn& one) {
    return JudgedPair::Side{&one.parts, one.rate_hz, one.compared_hz, one.ShareOf(before.metric)};
  };
  for (std::size_t t = 0; t < std::min(cells.judged.size(), others.judged.size()); ++t) {
    if (before.values[t] && after.values[t]) judged.push_back({side(cells.judged[t]), side(others.judged[t])});
  }
  return WhyNotAlike(*FindMetric(before.metric), judged, "before", "now");
}

std::vector<std::optional<double>> OkIn(const std::string& statuses) {
  std::vector<std::optional<double>> ok;
  for (char letter : statuses) ok.emplace_back(letter == 'o' ? 1.0 : 0.0);
  return ok;
}

TailRule RuleOf(const std::string& scenario, const TailRules& tails) {
  const auto found = tails.find(scenario);
  return found == tails.end() ? TailRule{} : found->second;
}

std::vector<std::string> WhyNotComparable(const SnapshotScenario& before, const SnapshotScenario& after) {
  std::vector<std::string> reasons;
  const auto differ = [&](std::string_view what, auto a, auto b) {
    if (a != b) reasons.push_back(fmt::format("{}: {} was {} and is {}", before.name, what, a, b));
  };
  differ("the seed", before.seed, after.seed);
  // If the worlds are made of files, the numbers of trials may differ, because an added or removed file does not change
  // the other worlds.
  const bool are_files = !before.files.empty() && !after.files.empty();
  if (!are_files) differ("the number of trials", before.trials, after.trials);
  for (const auto& [condition, digest] : before.worlds) {
    const std::string* other = FindDigest(after.worlds, condition);
    if (other == nullptr || *other == digest) continue;
    reasons.push_back(
        fmt::format("{}: under condition {}, the two runs have different parameters, different clips or different "
                    "versions of secret worlds",
                    before.name, condition));
  }
  for (const auto& metric : before.metrics) {
    const auto* other = FindIn(after.metrics, [&](const auto& pair) { return pair.first == metric.first; });
    if (other != nullptr) differ("the version of " + metric.first, metric.second, other->second);
  }
  return reasons;
}

}  // namespace

std::vector<std::string> WhyNotComparable(const Snapshot& before, const Snapshot& after) {
  std::vector<std::string> reasons;
  for (const SnapshotScenario& scenario : before.scenarios) {
    const SnapshotScenario* partner = FindScenario(after, scenario.name);
    if (partner == nullptr) continue;
    for (std::string& reason : WhyNotComparable(scenario, *partner)) reasons.push_back(std::move(reason));
  }
  return reasons;
}

std::vector<std::string> DropIncomparable(Snapshot& before, Snapshot& after) {
  std::vector<std::string> reasons = WhyNotComparable(before, after);
  std::set<std::string> dropped;
  for (const SnapshotScenario& scenario : before.scenarios) {
    const SnapshotScenario* partner = FindScenario(after, scenario.name);
    if (partner != nullptr && !WhyNotComparable(scenario, *partner).empty()) dropped.insert(scenario.name);
  }
  for (Snapshot* snapshot : {&before, &after}) {
    std::erase_if(snapshot->scenarios, [&](const SnapshotScenario& one) { return dropped.contains(one.name); });
  }
  return reasons;
}

SnapshotComparison CompareSnapshots(const Snapshot& before, const Snapshot& after, const std::set<std::string>& exact,
                                    const TailRules& tails) {
  SnapshotComparison comparison;
  // List the entries that only one of the snapshots contains.
  comparison.only_before = OnlyIn(before, after);
  comparison.only_after = OnlyIn(after, before);
  for (const SnapshotScenario& scenario : before.scenarios) {
    const SnapshotScenario* partner = FindScenario(after, scenario.name);
    if (partner == nullptr) continue;
    // List methods whose settings changed.
    for (const auto& [method, digest] : scenario.methods) {
      const std::string* other = FindDigest(partner->methods, method);
      if (other != nullptr && *other != digest) comparison.settings_changed.push_back(scenario.name + ", " + method);
    }
    const SharedWorlds shared = FindShared(scenario, *partner, comparison);
    for (const SnapshotCells& all_cells : scenario.cells) {
      const SnapshotCells* all_others = FindCells(*partner, all_cells);
      if (all_others == nullptr) continue;
      const SnapshotCells cells = Picked(all_cells, shared.before), kept_others = Picked(*all_others, shared.after);
      const SnapshotCells* others = &kept_others;
      const std::vector<bool> compared = WorldsToCompare(cells, *others);
      // Compare the share of ok cells and the values of every metric, world by world.
      const auto add = [&](const std::string& metric, const auto& values, const auto& other_values,
                           std::string not_alike) {
        const MetricInfo& info = *FindGateMetric(metric);
        const MoveColumns columns{values,   other_values,   WeightsOf(cells, info), WeightsOf(*others, info),
                                  compared, cells.statuses, others->statuses,       std::move(not_alike)};
        MetricMove& move = comparison.moves.emplace_back(
            MeasureMove({scenario.name, cells.condition, cells.method, metric}, columns, scenario.seed));
        move.tail = FindTail(columns, info, RuleOf(scenario.name, tails));
        for (TailWorld& world : move.tail) world.trial = static_cast<int>(shared.after[world.trial]);
      };
      add(kOkShare, OkIn(cells.statuses), OkIn(others->statuses), "");
      // An exact comparison also counts cells whose status changed between `unsolved` and `failed`; the share of ok
      // cells does not show such changes.
      if (exact.contains(scenario.name)) comparison.moves.back().differing = CountDiffering(cells, *others, compared);
      for (const SnapshotValues& values : cells.metrics) {
        const SnapshotValues* other = FindValues(*others, values.metric);
        if (other != nullptr) {
          add(values.metric, values.values, other->values, WhyNotAlike(values, cells, *other, *others));
        }
      }
    }
  }
  // Judge the changes of all metrics together (Holm's correction), then judge single worlds by the tail rule.
  JudgeMoves(comparison.moves, exact);
  for (MetricMove& move : comparison.moves) JudgeTail(move, RuleOf(move.identity.scenario, tails));
  return comparison;
}

}  // namespace etude
