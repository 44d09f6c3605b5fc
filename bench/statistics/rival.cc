#include "bench/statistics/rival.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "bench/statistics/bootstrap.h"

namespace etude {
namespace {

/// Which half of the worlds a trial belongs to. Worlds of one unit are not torn apart.
int HalfOf(const ConditionTable& table, int trial) {
  const std::vector<int>& units = table.world_units[static_cast<std::size_t>(trial)];
  return (units.size() == 1 && table.units.size() > 1 ? units.front() : trial) % 2;
}

/// What stands for the value of a cell that failed: the worst that any method measured.
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

/// Of the candidates those that no other beats by as much as matters; all of them by a metric without values.
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

/// The best of the others in one half of the worlds: by the first headline metric, of those that it does not tell
/// apart by the second, and so on; of equal ones the first. "" when there is none.
std::string BestOther(const Study& study, const ConditionTable& table, const std::string& method, int half) {
  std::vector<const MethodColumns*> candidates;
  for (const ComparedMethod& other : study.methods) {
    if (other.name != method && Competes(study, other)) candidates.push_back(&table.Of(other.name));
  }
  for (const std::string& metric : study.metrics) candidates = BestBy(*FindMetric(metric), table, half, candidates);
  return candidates.empty() ? "" : candidates.front()->name();
}

}  // namespace

std::string Rival::Name() const { return of_half[0] == of_half[1] ? of_half[0] : of_half[0] + " or " + of_half[1]; }

std::string Rival::Note() const {
  if (of_half[0] == of_half[1]) return "";
  return fmt::format(
      "which method is strongest was chosen on the other half of the worlds: “{}” for one, “{}” for the other",
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

std::optional<Rival> FindRival(const Study& study, const ConditionTable& table, const std::string& method) {
  Rival rival;
  if (study.rival.empty()) {
    rival.of_half = {BestOther(study, table, method, 1), BestOther(study, table, method, 0)};
  } else if (study.rival != method) {
    rival.of_half = {study.rival, study.rival};
  }
  if (rival.of_half[0].empty() || rival.of_half[1].empty()) return std::nullopt;
  return rival;
}

PairedWorlds WorldsAgainst(const Rival& rival, const ConditionTable& table, const std::string& method,
                           const std::string& metric) {
  const std::array<const MethodColumns*, 2> of_half = {&table.Of(rival.of_half[0]), &table.Of(rival.of_half[1])};
  PairedWorlds worlds;
  for (int trial = 0; trial < table.trials(); ++trial) {
    AddWorld(*of_half[static_cast<std::size_t>(HalfOf(table, trial))], table.Of(method), metric, trial, worlds);
  }
  return worlds;
}

}  // namespace etude
