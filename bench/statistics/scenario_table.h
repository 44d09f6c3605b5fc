#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/model/study.h"
#include "bench/statistics/compare.h"
#include "engine/base/cyclic_lookup.h"

namespace etude {

/// The statuses and values of one method under one condition, trial by trial.
class MethodColumns {
 public:
  MethodColumns(std::string name, int trials) : name_(std::move(name)), statuses_(static_cast<std::size_t>(trials)) {}

  void Add(const Row& row);

  const std::string& name() const { return name_; }
  /// The status of the trial's cell; nothing where there is none.
  std::optional<Status> StatusAt(int trial) const { return statuses_[static_cast<std::size_t>(trial)]; }
  /// The trial's value of a metric; nothing where its cell has none.
  std::optional<double> ValueAt(const std::string& metric, int trial) const;
  /// All values of a metric in the order of trials; `missing` counts the cells without one.
  std::vector<double> ValuesOf(const std::string& metric, int& missing) const;
  /// True if some cell reports the metric, by a value or by the reason why there is none.
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

/// One metric of two methods in the worlds of a condition; a world that was skipped for both is in none of these.
struct PairedWorlds {
  std::vector<Pair> pairs;  ///< both have a value
  std::vector<int> trials;  ///< of the pairs
  int only_baseline = 0, only_method = 0, neither = 0;
  /// The trials of only_method and only_baseline where the other's cell failed, rather than having no such metric.
  std::vector<int> baseline_failed, method_failed;
};

PairedWorlds PairsOf(const ConditionTable& table, const std::string& baseline, const std::string& method,
                     const std::string& metric);

/// Adds one world to `paired`.
void AddWorld(const MethodColumns& baseline, const MethodColumns& method, const std::string& metric, int trial,
              PairedWorlds& paired);

/// Counts failures as losses in the same worlds: each in which one method alone failed counts as the largest
/// difference among the pairs, or one that just matters, against the method that failed (worst ranks, Lachin 1999).
/// Nothing when there is no such world, no pair, or no better direction.
std::optional<PairedWorlds> WithFailures(const PairedWorlds& paired, const MetricInfo& metric);

/// The text that keys the dice of a comparison, stable under adding methods, metrics or conditions.
std::string PurposeOf(const std::string& scenario, const std::vector<SweptValue>& condition, const std::string& metric,
                      const std::string& baseline, const std::string& method);

/// A method's strongest rival.
struct Rival {
  std::array<std::string, 2> of_half;  ///< whom it meets in the worlds of even units, and in those of odd ones

  std::string Name() const;  ///< "a", or "a or b" when the halves of the worlds chose differently
  std::string Note() const;  ///< how they were chosen, in words; "" when both are the same
};

/// True if a method competes: one that no method is compared with and that is compared with none is a yardstick, and
/// one with an oracle shows what could be.
bool Competes(const Study& study, const ComparedMethod& method);

/// True if a method has a rival (FindRival); told by the scenario alone.
bool HasRival(const Study& study, const ComparedMethod& method);

/// The scenario's own rival, or of all others that compete the best, the method's baseline left out: with that it is
/// compared anyway, in all worlds, and a rival that half of the worlds draw from it would be judged twice, the second
/// time with half of the evidence. So a method beats all others if it beats its baseline and its rival. The best is so
/// by the first headline metric, of those that differ there by less than matters by the next one, and so on. It is
/// chosen on other worlds than those it is judged on: on the worlds of odd units (trials where worlds are units, or of
/// several units) for those of even ones, and the other way round. A cell that failed counts as the condition's worst
/// value there. No rival for the rival itself, for what does not compete, where none but the baseline
/// does, and where a half has no world to choose on.
std::optional<Rival> FindRival(const Study& study, const ConditionTable& table, const ComparedMethod& method);

/// One metric of `method` and of whom it meets, in all worlds of the condition.
PairedWorlds WorldsAgainst(const Rival& rival, const ConditionTable& table, const std::string& method,
                           const std::string& metric);

}  // namespace etude
