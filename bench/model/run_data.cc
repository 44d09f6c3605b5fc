#include "bench/model/run_data.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <string_view>

namespace etude {

std::string DescribeWorlds(const RunData& run) {
  if (run.key_digest.empty()) return fmt::format("seed {}{}", run.seed, run.fence.empty() ? "" : ", open worlds");
  const bool is_unfenced = run.fence.starts_with("none");
  const bool is_swept =
      std::ranges::any_of(run.scenarios, [](const auto& scenario) { return scenario.conditions.size() > 1; });
  return fmt::format("secret worlds, key {}…{}{}", run.key_digest.substr(0, 16),
                     is_swept ? ", different worlds under each condition" : "",
                     is_unfenced ? ", programs ran without a fence" : "");
}

std::size_t CountRows(const RunData& run) { return run.source ? run.source->size() : run.rows.size(); }

void ForEachRow(const RunData& run, const std::function<void(const Row& row, std::size_t place)>& use) {
  if (!run.source) {
    for (std::size_t place = 0; place < run.rows.size(); ++place) use(run.rows[place], place);
    return;
  }
  Row row;
  for (std::size_t place = 0; place < run.source->size(); ++place) {
    run.source->Read(place, row);
    use(row, place);
  }
}

std::vector<SeriesGroup> GroupSeries(const RunData& run, const std::string& axis) {
  std::map<std::string_view, const std::vector<Series>*> held;  // the series of each cell, by the cell's name
  for (const CellSeries& cell : run.series) held.emplace(cell.cell, &cell.series);
  std::vector<SeriesGroup> groups;
  std::map<std::pair<std::string, std::string>, std::size_t> places;  // index in `groups`, by place and method
  const auto add = [&](const Row& row, const std::vector<Series>& series) {
    for (const Series& one : series) {
      if (one.axis != axis) continue;
      std::string at = row.scenario + '/' + CompactLabel(row.condition) + '/' + one.name;
      const auto [place, is_new] = places.emplace(std::pair(at, row.method), groups.size());
      if (is_new) groups.push_back({std::move(at), row.condition, row.method, one.name, {}, {}});
      groups[place->second].values.push_back(one.values);
      groups[place->second].units.push_back(row.units.empty() ? row.clip : row.units.front());
    }
  };
  ForEachRow(run, [&](const Row& row, std::size_t place) {
    if (run.source) return add(row, run.source->SeriesOf(place));
    const auto known = held.find(row.Id());
    if (known != held.end()) add(row, *known->second);
  });
  return groups;
}

Row RowAt(const RunData& run, std::size_t place) {
  if (!run.source) return run.rows[place];
  Row row;
  run.source->Read(place, row);
  return row;
}

std::optional<std::size_t> FindRow(const RunData& run, const std::string& id) {
  std::optional<std::size_t> found;
  ForEachRow(run, [&](const Row& row, std::size_t place) {
    if (!found && row.Id() == id) found = place;
  });
  return found;
}

std::optional<double> CpuSecondsOf(const RunData& run, const Row& row, std::size_t place) {
  if (run.source) return run.source->CpuSecondsOf(place);
  const auto found = run.cpu_seconds.find(row.Id());
  return found == run.cpu_seconds.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace etude
