#include "reports/growth/growth_curves.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "reports/words/cell_series.h"

namespace etude {
namespace {

constexpr const char* kFrames = "frames";

/// A condition apart into the library's size and everything else.
struct SizedCondition {
  double frames = 0;
  std::vector<SweptValue> rest;
};

std::optional<SizedCondition> TakeApart(const std::vector<SweptValue>& condition) {
  SizedCondition taken;
  for (const SweptValue& swept : condition) {
    if (swept.key != kFrames) {
      taken.rest.push_back(swept);
      continue;
    }
    const char* const end = swept.value.data() + swept.value.size();
    if (std::from_chars(swept.value.data(), end, taken.frames).ptr != end) return std::nullopt;
  }
  return taken.frames > 0 ? std::optional(taken) : std::nullopt;
}

/// Processor time of a query, microseconds; a cell that ended sooner than the clock ticks has none.
std::optional<double> MicrosecondsOf(const RunData& run, const Row& row, const CellSeriesIndex& series) {
  const auto seconds = run.cpu_seconds.find(row.Id());
  const std::vector<double>* queries = series.Find(row, "matches_per_query");
  if (seconds == run.cpu_seconds.end() || seconds->second <= 0 || queries == nullptr || queries->empty()) return {};
  constexpr double kMicro = 1e6;
  return kMicro * seconds->second / static_cast<double>(queries->size());
}

void AddMedian(double frames, std::vector<double> values, GrowthCurve& curve) {
  std::erase_if(values, [](double value) { return value <= 0; });  // has no logarithm
  if (!values.empty()) curve.points.push_back({frames, Median(std::move(values))});
}

void SortByFrames(std::vector<GrowthCurve>& curves) {
  for (GrowthCurve& curve : curves) std::ranges::sort(curve.points, {}, &GrowthPoint::frames);
}

}  // namespace

std::vector<Growth> ComputeGrowth(const RunData& run, const ScenarioSummary& scenario) {
  if (scenario.task != "search") return {};
  const CellSeriesIndex series(run);
  std::vector<Growth> all;
  for (const ConditionSummary& condition : scenario.conditions) {
    const auto sized = TakeApart(condition.condition);
    if (!sized) continue;
    const std::string label = ConditionLabel(sized->rest);
    auto growth = std::ranges::find(all, label, &Growth::label);
    if (growth == all.end()) growth = all.insert(growth, {label, {}, {}});
    growth->distances.resize(scenario.methods.size());
    growth->microseconds.resize(scenario.methods.size());
    const std::vector<const Row*> rows = RowsUnder(run, scenario, condition.condition);
    for (std::size_t m = 0; m < scenario.methods.size(); ++m) {
      std::vector<double> distances, microseconds;
      for (const Row* row : rows) {
        if (row->method != scenario.methods[m]) continue;
        if (const auto value = ValueOf(*row, "distances_per_query")) distances.push_back(*value);
        if (const auto value = MicrosecondsOf(run, *row, series)) microseconds.push_back(*value);
      }
      growth->distances[m].style = growth->microseconds[m].style = m;
      AddMedian(sized->frames, std::move(distances), growth->distances[m]);
      AddMedian(sized->frames, std::move(microseconds), growth->microseconds[m]);
    }
  }
  for (Growth& growth : all) {
    SortByFrames(growth.distances);
    SortByFrames(growth.microseconds);
  }
  return all;
}

}  // namespace etude
