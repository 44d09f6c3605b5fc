#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/model/study.h"
#include "bench/statistics/compare.h"
#include "bench/statistics/judged_alike.h"
#include "engine/base/cyclic_lookup.h"

namespace etude {

/// The statuses and metric values of one method under one condition, by trial.
class MethodColumns {
 public:
  MethodColumns(std::string name, int trials) : name_(std::move(name)), statuses_(static_cast<std::size_t>(trials)) {}

  void Add(const Row& row);

  const std::string& name() const { return name_; }
  /// Returns the status of the trial's cell; nothing if there is no such cell.
  std::optional<Status> StatusAt(int trial) const { return statuses_[static_cast<std::size_t>(trial)]; }
  /// Returns the trial's value of a metric; nothing if the trial's cell has none.
  std::optional<double> ValueAt(const std::string& metric, int trial) const;
  /// Returns what the trial's value of a metric was measured on; nothing if the cell does not state it.
  std::optional<JudgedPair::Side> JudgedAt(const std::string& metric, int trial) const;
  /// Returns all values of a metric in the order of trials. `missing` receives the number of cells without a value.
  std::vector<double> ValuesOf(const std::string& metric, int& missing) const;
  /// Returns the weights of the values of a metric, in the order of ValuesOf, scaled to mean 1 (MetricInfo::weight). A
  /// missing weight is 0. All weights are 1 if the metric has none, or if all are 0.
  std::vector<double> WeightsOf(const MetricInfo& metric) const;
  /// Returns true if a cell reports the metric: it has a value, or a reason why the value is missing.
  bool Reports(const std::string& metric) const { return values_.Find(metric) != nullptr; }

 private:
  void AddJudged(const JudgedOn& judged, std::size_t trial);

  std::string name_;
  std::vector<std::optional<Status>> statuses_;  ///< statuses by trial
  CyclicLookup<std::vector<double>> values_;     ///< values by metric and trial; NaN = none
  // JudgedOn of the cells. The columns are empty if no cell has it.
  std::vector<std::vector<std::string>> all_parts_;  ///< each list of parts once
  std::vector<std::size_t> parts_;                   ///< by trial, 1 + an index in all_parts_; 0 = the cell has none
  std::vector<double> rates_, compared_rates_;
  CyclicLookup<std::vector<double>> shares_;  ///< shares by metric and trial; NaN = 1
};

/// All values and statuses measured under one condition.
struct ConditionTable {
  std::vector<SweptValue> condition;
  std::vector<MethodColumns> methods;  ///< methods in the order of the study
  std::vector<std::string> units;      ///< names of all units, in the order of first occurrence
  /// For each trial, the indices of the units from which its world was drawn.
  std::vector<std::vector<int>> world_units;

  const MethodColumns& Of(const std::string& method) const;
  int trials() const { return static_cast<int>(world_units.size()); }
};

/// The rows of one study as columns of numbers, 8 bytes per value. Statistics need no other data of the rows.
class ScenarioTable {
 public:
  explicit ScenarioTable(const Study& study);

  /// Adds a row. Rows may come in any order. A row of another study, condition, method or trial is ignored.
  void Add(const Row& row);

  std::span<const ConditionTable> conditions() const { return conditions_; }

 private:
  ConditionTable* Find(const Row& row);

  std::string scenario_;
  std::vector<ConditionTable> conditions_;
  /// The condition of the row added last. It is tried first, because rows of one condition follow each other.
  std::size_t last_ = 0;
};

/// Returns the half of the worlds to which a trial belongs: the index of the world's unit modulo 2, so all worlds of
/// a unit are in the same half. If the world has no unit or several, or if there is only one unit, the half is the
/// number of the trial modulo 2.
int HalfOf(const ConditionTable& table, int trial);

/// The values of one metric for two methods in the worlds of a condition. Worlds that both methods skipped are left
/// out.
struct PairedWorlds {
  std::vector<Pair> pairs;  ///< one pair for each world in which both methods have a value
  std::vector<int> trials;  ///< the trial of each pair
  int only_baseline = 0, only_method = 0, neither = 0;
  /// Trials in which a cell failed and did not merely lack this metric. baseline_failed lists trials of only_method in
  /// which the baseline's cell failed; method_failed lists trials of only_baseline in which the method's cell failed.
  std::vector<int> baseline_failed, method_failed;
  std::string not_alike = {};  ///< why the pairs cannot be compared (WhyNotAlike); "" = they can
};

/// Returns the pairs of values of `baseline` and `method` in all worlds of the condition.
PairedWorlds PairsOf(const ConditionTable& table, const std::string& baseline, const std::string& method,
                     const std::string& metric);

/// Counts failures as losses: in each world in which only one method failed, that method is worse by the largest
/// difference among the pairs, and at least by the practical threshold, or by 1 for shares (worst ranks, Lachin 1999).
/// Returns nothing if there is no such world, if there is no pair, or if the metric has no direction.
std::optional<PairedWorlds> WithFailures(const PairedWorlds& paired, const MetricInfo& metric);

/// Returns the text that keys the random streams of the intervals and tests of a metric in a condition. It contains no
/// name of a method, so equal values have equal intervals and p-values, whatever their methods are called. It does not
/// change if methods, metrics or conditions are added.
std::string PurposeOf(const std::string& scenario, const std::vector<SweptValue>& condition, const std::string& metric);

/// The strongest rival of a method.
struct Rival {
  std::array<std::string, 2> of_half;  ///< the rival in each half of the worlds (HalfOf)

  std::string Name() const;  ///< the rival's name: "a", or "a or b" if the two halves have different rivals
  std::string Note() const;  ///< says how the two rivals were chosen; "" if they are the same
};

/// Returns true if a method competes. Two kinds of methods do not compete: a method that takes part in no comparison
/// and only serves as a yardstick, and a method with an oracle, which shows an upper bound.
bool Competes(const Study& study, const ComparedMethod& method);

/// Returns true if the scenario allows a rival of this method (FindRival). The results have no influence.
bool HasRival(const Study& study, const ComparedMethod& method);

/// Returns the rival that the scenario names, or else the best of all other competing methods. The method's baseline is
/// not a candidate, because the two are compared in all worlds anyway. A method therefore beats all others if it beats
/// its baseline and its rival.
///
/// The best method is chosen by the first headline metric. Methods that are worse than the best by less than the
/// practical threshold are compared by the next metric, and so on. A cell without a value counts as the worst value
/// of the condition, unless it was skipped. Each half of the worlds (HalfOf) gets the rival that is the best method
/// in the other half, so a rival is never judged in the worlds in which it was chosen.
///
/// Returns nothing if the method is itself the rival or does not compete, if only the baseline competes, or if one half
/// has no worlds from which to choose.
std::optional<Rival> FindRival(const Study& study, const ConditionTable& table, const ComparedMethod& method);

/// Returns the pairs of values of `method` and of its rival, in all worlds of the condition.
PairedWorlds WorldsAgainst(const Rival& rival, const ConditionTable& table, const std::string& method,
                           const std::string& metric);

}  // namespace etude
