#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/model/study.h"
#include "engine/base/cyclic_lookup.h"

namespace etude {

/// What one method came to under one condition, trial by trial.
class MethodColumns {
 public:
  MethodColumns(std::string name, int trials) : name_(std::move(name)), statuses_(static_cast<std::size_t>(trials)) {}

  void Add(const Row& row);

  const std::string& name() const { return name_; }
  /// How its cell ended; nothing where there is none.
  std::optional<Status> StatusAt(int trial) const { return statuses_[static_cast<std::size_t>(trial)]; }
  /// Nothing where its cell has no such value.
  std::optional<double> ValueAt(const std::string& metric, int trial) const;
  /// All values of a metric in the order of trials; `missing` counts the cells without one.
  std::vector<double> ValuesOf(const std::string& metric, int& missing) const;
  /// Whether some cell says anything of the metric, a value or why there is none.
  bool Reports(const std::string& metric) const { return values_.Find(metric) != nullptr; }

 private:
  std::string name_;
  std::vector<std::optional<Status>> statuses_;  ///< by trial
  CyclicLookup<std::vector<double>> values_;     ///< by metric and trial; NaN = none
};

/// Everything measured under one condition.
struct ConditionTable {
  std::vector<SweptValue> condition;
  std::vector<MethodColumns> methods;         ///< as the study lists them
  std::vector<std::string> units;             ///< names of all units, in the order in which they were met
  std::vector<std::vector<int>> world_units;  ///< by trial: indices of the units that the world was drawn from

  const MethodColumns& Of(const std::string& method) const;
  int trials() const { return static_cast<int>(world_units.size()); }
};

/// One study's rows as columns of numbers: what statistics keep of a run, 8 bytes a value, while rows pass by.
class ScenarioTable {
 public:
  explicit ScenarioTable(const Study& study);

  /// Takes a row of the study, in any order; one of another study, condition, method or trial is not taken.
  void Add(const Row& row);

  std::span<const ConditionTable> conditions() const { return conditions_; }

 private:
  ConditionTable* Find(const Row& row);

  std::string scenario_;
  std::vector<ConditionTable> conditions_;
  std::size_t last_ = 0;  ///< rows of one condition come together
};

}  // namespace etude
