#include "bench/statistics/scenario_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "bench/statistics/bootstrap.h"

namespace etude {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Returns the worst value that any method reached under the condition. Cells without a value get this value, unless
/// they were skipped. Returns nothing if there is no value.
std::optional<double> WorstOf(const ConditionTable& table, const MetricInfo& metric) {
  std::optional<double> worst;
  for (const MethodColumns& method : table.methods) {
    int missing = 0;
    for (double value : method.ValuesOf(metric.id, missing)) {
      const bool is_worse =
          !worst || (metric.direction == Direction::kHigherIsBetter ? value < *worst : value > *worst);
      if (is_worse) worst = value;
    }
  }
  return worst;
}

/// Returns the method's aggregate over one half of the worlds; cells without a value count as `worst`. Returns
/// nothing if the method was skipped in all worlds of the half.
std::optional<double> ScoreOf(const ConditionTable& table, const MethodColumns& method, const MetricInfo& metric,
                              double worst, int half) {
  std::vector<double> values;
  for (int trial = 0; trial < table.trials(); ++trial) {
    if (HalfOf(table, trial) != half) continue;
    if (method.StatusAt(trial).value_or(Status::kSkipped) == Status::kSkipped) continue;
    values.push_back(method.ValueAt(metric.id, trial).value_or(worst));
  }
  if (values.empty()) return std::nullopt;
  return AggregateOf(values, metric.aggregate);
}

/// Returns the candidates that are within the practical threshold of the best one. Returns all candidates if the metric
/// has no values or no direction.
std::vector<const MethodColumns*> BestBy(const MetricInfo& metric, const ConditionTable& table, int half,
                                         const std::vector<const MethodColumns*>& candidates) {
  const auto worst = WorstOf(table, metric);
  if (metric.direction == Direction::kNeither || !worst) return candidates;
  const double sign = metric.direction == Direction::kLowerIsBetter ? 1 : -1;
  std::vector<std::pair<double, const MethodColumns*>> scores;
  double best = std::numeric_limits<double>::infinity();
  for (const MethodColumns* method : candidates) {
    const auto score = ScoreOf(table, *method, metric, *worst, half);
    if (!score) continue;
    scores.emplace_back(sign * *score, method);
    best = std::min(best, sign * *score);
  }
  std::vector<const MethodColumns*> kept;
  for (const auto& [score, method] : scores) {
    if (score < best + metric.practical || score == best) kept.push_back(method);
  }
  return kept;
}

/// Returns true if `other` may be the strongest rival of `method`: it competes and is not the method's baseline.
bool IsCandidate(const Study& study, const ComparedMethod& method, const ComparedMethod& other) {
  return other.name != method.name && other.name != method.against && Competes(study, other);
}

/// Returns the best candidate in one half of the worlds by the first headline metric. If several candidates are equally
/// good, the second metric decides between them, and so on; finally the order of the methods decides. Returns "" if
/// there is no candidate.
std::string BestOther(const Study& study, const ConditionTable& table, const ComparedMethod& method, int half) {
  std::vector<const MethodColumns*> candidates;
  for (const ComparedMethod& other : study.methods) {
    if (IsCandidate(study, method, other)) candidates.push_back(&table.Of(other.name));
  }
  for (const std::string& metric : study.metrics) candidates = BestBy(*FindMetric(metric), table, half, candidates);
  return candidates.empty() ? "" : candidates.front()->name();
}

/// Adds one world to `paired`: a pair, or one more world without a pair.
void AddWorld(const MethodColumns& baseline, const MethodColumns& method, const std::string& metric, int trial,
              PairedWorlds& paired) {
  // A cell that was never run counts as skipped.
  const auto skipped = [&](const MethodColumns& columns) {
    return columns.StatusAt(trial).value_or(Status::kSkipped) == Status::kSkipped;
  };
  const auto failed = [&](const MethodColumns& columns) {
    return !skipped(columns) && columns.StatusAt(trial) != Status::kOk;
  };
  const auto of_baseline = baseline.ValueAt(metric, trial), of_method = method.ValueAt(metric, trial);
  if (of_baseline && of_method) {
    paired.pairs.push_back({*of_baseline, *of_method});
    paired.trials.push_back(trial);
  } else if (of_baseline) {
    ++paired.only_baseline;
    if (failed(method)) paired.method_failed.push_back(trial);
  } else if (of_method) {
    ++paired.only_method;
    if (failed(baseline)) paired.baseline_failed.push_back(trial);
  } else if (!skipped(baseline) || !skipped(method)) {
    ++paired.neither;
  }
}

/// Returns why the pairs of a metric cannot be compared (WhyNotAlike). `baseline_at(trial)` is the other method.
template <typename BaselineAt>
std::string WhyNotAlike(const PairedWorlds& paired, const std::string& metric, const BaselineAt& baseline_at,
                        const MethodColumns& method, const std::string& name_of_baseline) {
  std::vector<JudgedPair> judged;
  for (const int trial : paired.trials) {
    const auto theirs = baseline_at(trial).JudgedAt(metric, trial), mine = method.JudgedAt(metric, trial);
    if (theirs && mine) judged.push_back({*theirs, *mine});
  }
  return judged.empty() ? "" : WhyNotAlike(*FindMetric(metric), judged, name_of_baseline, method.name());
}

/// Multiplies the values of each pair by the world's weight (MetricInfo::weight) divided by the mean weight. The plain
/// mean of differences then is the weighted mean, and the tests are weighted, too. All cells of a world have the same
/// weight, because the weight depends on the truth alone. Does nothing for metrics without weights.
void WeighPairs(const MethodColumns& method, const std::string& metric, PairedWorlds& paired) {
  const MetricInfo* info = FindMetric(metric);
  if (info == nullptr || info->weight.empty()) return;
  double sum = 0;
  const auto weight_of = [&](int trial) { return method.ValueAt(info->weight, trial).value_or(0); };
  for (const int trial : paired.trials) sum += weight_of(trial);
  for (std::size_t i = 0; i < paired.pairs.size() && sum > 0; ++i) {
    const double factor = weight_of(paired.trials[i]) * static_cast<double>(paired.pairs.size()) / sum;
    paired.pairs[i] = {factor * paired.pairs[i].baseline, factor * paired.pairs[i].method};
  }
}

}  // namespace

int HalfOf(const ConditionTable& table, int trial) {
  const std::vector<int>& units = table.world_units[static_cast<std::size_t>(trial)];
  return (units.size() == 1 && table.units.size() > 1 ? units.front() : trial) % 2;
}

void MethodColumns::Add(const Row& row) {
  const auto trial = static_cast<std::size_t>(row.trial);
  statuses_[trial] = row.result.status;
  for (const MetricValue& metric : row.result.metrics) {
    std::vector<double>* column = values_.Find(metric.id);
    if (column == nullptr) column = &values_.Add(metric.id, std::vector<double>(statuses_.size(), kNone));
    if (metric.value) (*column)[trial] = *metric.value;
  }
  AddJudged(row.result.judged, trial);
}

void MethodColumns::AddJudged(const JudgedOn& judged, std::size_t trial) {
  if (judged.parts.empty()) return;
  parts_.resize(statuses_.size());
  rates_.resize(statuses_.size());
  compared_rates_.resize(statuses_.size());
  auto parts = std::ranges::find(all_parts_, judged.parts);
  if (parts == all_parts_.end()) parts = all_parts_.insert(parts, judged.parts);
  parts_[trial] = 1 + static_cast<std::size_t>(parts - all_parts_.begin());
  rates_[trial] = judged.rate_hz;
  compared_rates_[trial] = judged.compared_hz;
  for (const auto& [metric, share] : judged.shares) {
    std::vector<double>* column = shares_.Find(metric);
    if (column == nullptr) column = &shares_.Add(metric, std::vector<double>(statuses_.size(), kNone));
    (*column)[trial] = share;
  }
}

std::optional<JudgedPair::Side> MethodColumns::JudgedAt(const std::string& metric, int trial) const {
  const auto at = static_cast<std::size_t>(trial);
  if (parts_.empty() || parts_[at] == 0) return std::nullopt;
  const std::vector<double>* shares = shares_.Find(metric);
  const double share = shares == nullptr || std::isnan((*shares)[at]) ? 1 : (*shares)[at];
  return JudgedPair::Side{&all_parts_[parts_[at] - 1], rates_[at], compared_rates_[at], share};
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

std::vector<double> MethodColumns::WeightsOf(const MetricInfo& metric) const {
  std::vector<double> weights;
  double sum = 0;
  for (int trial = 0; trial < static_cast<int>(statuses_.size()); ++trial) {
    if (!StatusAt(trial) || !ValueAt(metric.id, trial)) continue;
    weights.push_back(metric.weight.empty() ? 1 : ValueAt(metric.weight, trial).value_or(0));
    sum += weights.back();
  }
  for (double& weight : weights) weight = sum > 0 ? weight * static_cast<double>(weights.size()) / sum : 1;
  return weights;
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
  if (!units.empty()) return;  // all methods of a world have the same units
  for (const std::string& name : row.units) {
    const auto known = std::find(table->units.begin(), table->units.end(), name);
    units.push_back(static_cast<int>(known - table->units.begin()));
    if (known == table->units.end()) table->units.push_back(name);
  }
}

PairedWorlds PairsOf(const ConditionTable& table, const std::string& baseline, const std::string& method,
                     const std::string& metric) {
  PairedWorlds paired;
  const MethodColumns &of_baseline = table.Of(baseline), &of_method = table.Of(method);
  for (int trial = 0; trial < table.trials(); ++trial) AddWorld(of_baseline, of_method, metric, trial, paired);
  WeighPairs(of_method, metric, paired);
  const auto baseline_at = [&](int) -> const MethodColumns& { return of_baseline; };
  paired.not_alike = WhyNotAlike(paired, metric, baseline_at, of_method, baseline);
  return paired;
}

std::optional<PairedWorlds> WithFailures(const PairedWorlds& paired, const MetricInfo& metric) {
  const bool all_answered = paired.baseline_failed.empty() && paired.method_failed.empty();
  if (all_answered || paired.pairs.empty() || metric.direction == Direction::kNeither) return std::nullopt;
  double largest = AreShares(paired.pairs, metric) ? 1 : metric.practical;
  for (const Pair& pair : paired.pairs) largest = std::max(largest, std::abs(pair.method - pair.baseline));
  const bool lower = metric.direction == Direction::kLowerIsBetter;
  const Pair loss = lower ? Pair{0, largest} : Pair{largest, 0}, win{loss.method, loss.baseline};
  PairedWorlds all = paired;
  all.pairs.insert(all.pairs.end(), paired.method_failed.size(), loss);
  all.pairs.insert(all.pairs.end(), paired.baseline_failed.size(), win);
  all.trials.insert(all.trials.end(), paired.method_failed.begin(), paired.method_failed.end());
  all.trials.insert(all.trials.end(), paired.baseline_failed.begin(), paired.baseline_failed.end());
  return all;
}

std::string PurposeOf(const std::string& scenario, const std::vector<SweptValue>& condition,
                      const std::string& metric) {
  return fmt::format("{}/{}/{}", scenario, ConditionLabel(condition), metric);
}

std::string Rival::Name() const { return of_half[0] == of_half[1] ? of_half[0] : of_half[0] + " or " + of_half[1]; }

std::string Rival::Note() const {
  if (of_half[0] == of_half[1]) return "";
  return fmt::format(
      "for each half of the worlds, the strongest method was chosen on the other half: “{}” for one half, “{}” for the "
      "other",
      of_half[0], of_half[1]);
}

bool Competes(const Study& study, const ComparedMethod& method) {
  if (method.has_oracle) return false;
  const bool is_first = method.name == study.methods.front().name;
  if (is_first || method.against != method.name) return true;
  return std::any_of(study.methods.begin(), study.methods.end(), [&](const ComparedMethod& other) {
    return other.name != method.name && other.against == method.name;
  });
}

bool HasRival(const Study& study, const ComparedMethod& method) {
  if (!Competes(study, method)) return false;
  if (!study.rival.empty()) return method.name != study.rival;
  return std::ranges::any_of(study.methods,
                             [&](const ComparedMethod& other) { return IsCandidate(study, method, other); });
}

std::optional<Rival> FindRival(const Study& study, const ConditionTable& table, const ComparedMethod& method) {
  if (!HasRival(study, method)) return std::nullopt;
  if (!study.rival.empty()) return Rival{{study.rival, study.rival}};
  Rival rival{{BestOther(study, table, method, 1), BestOther(study, table, method, 0)}};
  // If one half has no worlds, no rival can be chosen from it.
  if (rival.of_half[0].empty() || rival.of_half[1].empty()) return std::nullopt;
  return rival;
}

PairedWorlds WorldsAgainst(const Rival& rival, const ConditionTable& table, const std::string& method,
                           const std::string& metric) {
  const std::array<const MethodColumns*, 2> of_half = {&table.Of(rival.of_half[0]), &table.Of(rival.of_half[1])};
  const auto baseline_at = [&](int trial) -> const MethodColumns& {
    return *of_half[static_cast<std::size_t>(HalfOf(table, trial))];
  };
  PairedWorlds worlds;
  for (int trial = 0; trial < table.trials(); ++trial) {
    AddWorld(baseline_at(trial), table.Of(method), metric, trial, worlds);
  }
  WeighPairs(table.Of(method), metric, worlds);
  worlds.not_alike = WhyNotAlike(worlds, metric, baseline_at, table.Of(method), rival.Name());
  return worlds;
}

}  // namespace etude
