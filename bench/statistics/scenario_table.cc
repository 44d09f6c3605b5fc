#include "bench/statistics/scenario_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace etude {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void MethodColumns::Add(const Row& row) {
  const auto trial = static_cast<std::size_t>(row.trial);
  statuses_[trial] = row.result.status;
  for (const MetricValue& metric : row.result.metrics) {
    std::vector<double>* column = values_.Find(metric.id);
    if (column == nullptr) column = &values_.Add(metric.id, std::vector<double>(statuses_.size(), kNone));
    if (metric.value) (*column)[trial] = *metric.value;
  }
}

std::optional<double> MethodColumns::ValueAt(const std::string& metric, int trial) const {
  const std::vector<double>* column = values_.Find(metric);
  const double value = column == nullptr ? kNone : (*column)[static_cast<std::size_t>(trial)];
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::vector<double> MethodColumns::ValuesOf(const std::string& metric, int& missing) const {
  const std::vector<double>* column = values_.Find(metric);
  missing = 0;
  std::vector<double> values;
  for (std::size_t trial = 0; trial < statuses_.size(); ++trial) {
    if (!statuses_[trial]) continue;
    const double value = column == nullptr ? kNone : (*column)[trial];
    std::isnan(value) ? static_cast<void>(++missing) : values.push_back(value);
  }
  return values;
}

const MethodColumns& ConditionTable::Of(const std::string& method) const {
  const auto found = std::find_if(methods.begin(), methods.end(),
                                  [&](const MethodColumns& columns) { return columns.name() == method; });
  assert(found != methods.end());
  return *found;
}

ScenarioTable::ScenarioTable(const Study& study) : scenario_(study.scenario) {
  for (const std::vector<SweptValue>& condition : study.conditions) {
    ConditionTable& table = conditions_.emplace_back();
    table.condition = condition;
    table.world_units.resize(static_cast<std::size_t>(study.trials));
    for (const ComparedMethod& method : study.methods) table.methods.emplace_back(method.name, study.trials);
  }
}

ConditionTable* ScenarioTable::Find(const Row& row) {
  if (row.scenario != scenario_) return nullptr;
  if (last_ < conditions_.size() && conditions_[last_].condition == row.condition) return &conditions_[last_];
  for (last_ = 0; last_ < conditions_.size(); ++last_) {
    if (conditions_[last_].condition == row.condition) return &conditions_[last_];
  }
  return nullptr;
}

void ScenarioTable::Add(const Row& row) {
  ConditionTable* table = Find(row);
  if (table == nullptr || row.trial < 0 || row.trial >= table->trials()) return;
  const auto method = std::find_if(table->methods.begin(), table->methods.end(),
                                   [&](const MethodColumns& columns) { return columns.name() == row.method; });
  if (method == table->methods.end()) return;
  method->Add(row);
  std::vector<int>& units = table->world_units[static_cast<std::size_t>(row.trial)];
  if (!units.empty()) return;  // the methods of a world share its units
  for (const std::string& name : row.units) {
    const auto known = std::find(table->units.begin(), table->units.end(), name);
    units.push_back(static_cast<int>(known - table->units.begin()));
    if (known == table->units.end()) table->units.push_back(name);
  }
}

}  // namespace etude
