#include "reports/plots/paired_worlds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "reports/plots/swarm.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

struct Found {
  const Row* row = nullptr;
  std::optional<double> baseline, method;
};

std::vector<std::string> UnitNames(const std::map<int, Found>& found) {
  std::set<std::string> names;
  for (const auto& [trial, world] : found) {
    if (!world.row->units.empty()) names.insert(world.row->units.front());
  }
  return {names.begin(), names.end()};
}

}  // namespace

PairedDots PairedWorldsOf(const RunData& run, const ScenarioSummary& scenario, const Judged& judged) {
  const Comparison& c = *judged.comparison;
  const double scale = WordsFor(c.metric).scale;
  std::map<int, Found> found;
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name || row.condition != judged.condition->condition) continue;
    if (row.method != c.baseline && row.method != c.method) continue;
    const auto value = ValueOf(row, c.metric);
    if (!value || !std::isfinite(*value)) continue;
    Found& world = found[row.trial];
    world.row = &row;
    (row.method == c.method ? world.method : world.baseline) = scale * *value;
  }
  std::erase_if(found, [](const auto& entry) { return !entry.second.baseline || !entry.second.method; });

  PairedDots pairs;
  pairs.total = found.size();
  pairs.units = UnitNames(found);
  const std::size_t stride = StrideFor(found.size(), kMostWorlds);
  std::size_t index = 0;
  for (const auto& [trial, world] : found) {
    if (index++ % stride != 0) continue;
    PairedWorld& pair = pairs.worlds.emplace_back();
    pair.trial = trial;
    pair.baseline = *world.baseline;
    pair.method = *world.method;
    if (world.row->units.empty()) continue;
    pair.unit =
        static_cast<std::size_t>(std::ranges::lower_bound(pairs.units, world.row->units.front()) - pairs.units.begin());
  }
  return pairs;
}

}  // namespace etude
