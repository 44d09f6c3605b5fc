#include "reports/plots/verdicts.h"

#include <cmath>

#include "reports/words/cell_series.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

/// Finds the series of a cell by name. A series that does not have `count` values counts as missing (null).
class Columns {
 public:
  Columns(const CellSeries& cell, std::size_t count) : cell_(cell), count_(count) {}

  const Series* Find(std::string_view name) const {
    const Series* found = FindByName(cell_.series, name);
    return found == nullptr || found->values.size() != count_ ? nullptr : found;
  }

  /// Returns the category name that the i-th value of a series stands for; "" if the value is −1 or has no name.
  static std::string Name(const Series* series, std::size_t i) {
    if (series == nullptr || !(series->values[i] >= 0)) return "";
    const auto place = static_cast<std::size_t>(std::lround(series->values[i]));
    return place < series->names.size() ? series->names[place] : "";
  }

 private:
  const CellSeries& cell_;
  std::size_t count_;
};

std::size_t LengthOf(const CellSeries& cell, std::string_view name) {
  const Series* found = FindByName(cell.series, name);
  return found == nullptr ? 0 : found->values.size();
}

void Add(const CellSeries& cell, int person, MethodVerdicts& verdicts) {
  const Columns columns(cell, LengthOf(cell, "performance_score"));
  const Series *score = columns.Find("performance_score"), *truth = columns.Find("performance_truth"),
               *called = columns.Find("performance_called"), *severity = columns.Find("performance_severity"),
               *named = columns.Find("performance_named");
  if (score == nullptr || truth == nullptr || called == nullptr || severity == nullptr) return;
  for (std::size_t i = 0; i < score->values.size(); ++i) {
    JudgedPerformance& one = verdicts.performances.emplace_back();
    one.person = person;
    one.score = score->values[i];
    one.truth = truth->values[i];
    one.is_called = called->values[i] > 0;
    one.severity = severity->values[i];
    one.fault = Columns::Name(columns.Find("performance_fault"), i);
    one.danced = Columns::Name(columns.Find("performance_danced"), i);
    if (named != nullptr) one.named = Columns::Name(named, i);
  }
  const Columns right(cell, LengthOf(cell, "right_wait_s"));
  const Series *waited = right.Find("right_wait_s"), *is_over = right.Find("right_answered");
  if (waited == nullptr || is_over == nullptr) return;
  for (std::size_t i = 0; i < waited->values.size(); ++i) {
    verdicts.waits.push_back({waited->values[i], is_over->values[i] > 0});
  }
}

}  // namespace

std::map<std::size_t, MethodVerdicts> VerdictsUnder(const RunData& run, const ScenarioSummary& scenario,
                                                    const ConditionSummary& condition) {
  if (scenario.task != "detection") return {};
  std::map<std::string, const Row*> rows;
  for (const Row* row : RowsUnder(run, scenario.name, condition.condition)) rows.emplace(row->Id(), row);
  std::map<std::size_t, MethodVerdicts> verdicts;
  for (const CellSeries& cell : run.series) {
    const auto row = rows.find(cell.cell);
    if (row == rows.end()) continue;
    Add(cell, row->second->trial, verdicts[IndexOf(scenario, row->second->method)]);
  }
  std::erase_if(verdicts, [](const auto& entry) { return entry.second.performances.empty(); });
  return verdicts;
}

}  // namespace etude
