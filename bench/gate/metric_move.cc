#include "bench/gate/metric_move.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/compare.h"
#include "bench/statistics/judging.h"

namespace etude {
namespace {

using Column = std::vector<std::optional<double>>;

double WeightAt(const Column* weights, std::size_t trial) {
  return weights == nullptr ? 1 : (*weights)[trial].value_or(0);
}

/// Returns the aggregate of the compared worlds with a value: the weighted mean if a weight is above 0, otherwise the
/// metric's own aggregate. Returns nullopt without such a world.
std::optional<double> AggregateOfPresent(const Column& values, const Column* weights, const std::vector<bool>& compared,
                                         Aggregate aggregate) {
  std::vector<double> present;
  double weighted = 0, weight = 0;
  for (std::size_t t = 0; t < compared.size(); ++t) {
    if (!compared[t] || !values[t]) continue;
    present.push_back(*values[t]);
    weighted += WeightAt(weights, t) * *values[t];
    weight += WeightAt(weights, t);
  }
  if (present.empty()) return std::nullopt;
  return weights != nullptr && weight > 0 ? weighted / weight : AggregateOf(present, aggregate);
}

/// Multiplies both values of each pair by the pair's weight, divided by the mean weight. The mean of the products is
/// then the weighted mean. Does nothing if no weight is above 0.
void Weigh(std::vector<Pair>& pairs, std::span<const double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (sum <= 0) return;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double factor = weights[i] * static_cast<double>(pairs.size()) / sum;
    pairs[i] = {pairs[i].baseline * factor, pairs[i].method * factor};
  }
}

Movement MovementOf(const Comparison& comparison, const MetricInfo& metric) {
  switch (VerdictOf(comparison, metric)) {
    case Verdict::kBetter:
      return Movement::kBetter;
    case Verdict::kWorse:
      return Movement::kWorse;
    case Verdict::kNoDifference:
      return Movement::kNoMatter;
    case Verdict::kUndecided:
      break;
  }
  return Movement::kUndecided;
}

/// Combines two results for one metric: returns whichever of `a` and `b` comes first in the order worse, better,
/// undecided. Returns kNoMatter if neither is one of these three.
Movement MoreImportant(Movement a, Movement b) {
  for (Movement movement : {Movement::kWorse, Movement::kBetter, Movement::kUndecided}) {
    if (a == movement || b == movement) return movement;
  }
  return Movement::kNoMatter;
}

Comparison AsComparisonOfMeans(Comparison comparison) {
  comparison.difference = comparison.mean;
  comparison.ci_low = comparison.mean_low;
  comparison.ci_high = comparison.mean_high;
  return comparison;
}

void JudgeByThreshold(MetricMove& move) {
  const MetricInfo& metric = *FindGateMetric(move.identity.metric);
  move.movement = Movement::kNoMatter;
  if (move.comparison.differing > 0) {
    const Movement own = MovementOf(move.comparison, metric);
    move.movement = MoreImportant(own, MovementOf(AsComparisonOfMeans(move.comparison), metric));
    move.by_mean = move.movement != own;
  }
  if (move.presence) {
    move.movement = MoreImportant(move.movement, MovementOf(*move.presence, *FindGateMetric(kOkShare)));
  }
}

/// Applies Holm's correction for multiple testing to all comparisons in which at least one world differs.
void CorrectTogether(std::span<MetricMove> moves) {
  std::vector<Comparison*> family;
  std::vector<std::optional<double>> p_values;
  const auto add = [&](Comparison& comparison, const MetricInfo& metric) {
    family.push_back(&comparison);
    p_values.push_back(DecidingP(comparison, metric));
  };
  for (MetricMove& move : moves) {
    if (move.comparison.differing > 0) add(move.comparison, *FindGateMetric(move.identity.metric));
    if (move.presence) add(*move.presence, *FindGateMetric(kOkShare));
  }
  const auto corrected = HolmCorrected(p_values);
  for (std::size_t i = 0; i < family.size(); ++i) family[i]->p_holm = corrected[i];
}

constexpr char kOk = 'o', kUnsolved = 'u';

/// Returns how much worse a world became, as a multiple of the practical threshold; negative if the world became
/// better.
double Worse(double before, double after, const MetricInfo& metric) {
  switch (metric.direction) {
    case Direction::kLowerIsBetter:
      return (after - before) / metric.practical;
    case Direction::kHigherIsBetter:
      return (before - after) / metric.practical;
    case Direction::kNeither:
      break;
  }
  return 0;
}

char LetterAt(const std::string& letters, std::size_t trial) { return trial < letters.size() ? letters[trial] : kOk; }

}  // namespace

const MetricInfo* FindGateMetric(std::string_view id) {
  static const MetricInfo ok = [] {
    MetricInfo metric;
    metric.id = kOkShare;
    metric.label = "cells that ended ok";
    metric.direction = Direction::kHigherIsBetter;
    metric.aggregate = Aggregate::kMean;
    metric.reading = Reading::kYesNo;
    metric.practical = 0.02;  // the value in the catalogue for shares of solved problems
    return metric;
  }();
  return id == kOkShare ? &ok : FindMetric(id);
}

std::string_view MovementWords(Movement movement) {
  constexpr std::array<std::string_view, 6> kWords = {"same",      "better", "worse", "too small to matter",
                                                      "undecided", "changed"};
  return kWords[static_cast<std::size_t>(movement)];
}

MetricMove MeasureMove(MoveIdentity identity, const MoveColumns& columns, std::uint64_t seed) {
  MetricMove move;
  move.identity = std::move(identity);
  // Collect the pairs of values of the compared worlds.
  std::vector<Pair> values, presence;
  std::vector<double> weights;
  for (std::size_t t = 0; t < columns.compared.size(); ++t) {
    if (!columns.compared[t]) continue;
    const auto &before = columns.before[t], &after = columns.after[t];
    move.differing += before != after;
    move.lost += before && !after;
    move.gained += !before && after;
    presence.push_back({before ? 1.0 : 0.0, after ? 1.0 : 0.0});
    if (!before || !after) continue;
    values.push_back({*before, *after});
    weights.push_back(WeightAt(columns.weights_before, t));
  }
  // Compute the metric's aggregate over worlds, before and after.
  const MetricInfo& metric = *FindGateMetric(move.identity.metric);
  move.worlds = static_cast<int>(presence.size());
  move.before = AggregateOfPresent(columns.before, columns.weights_before, columns.compared, metric.aggregate);
  move.after = AggregateOfPresent(columns.after, columns.weights_after, columns.compared, metric.aggregate);
  const std::string purpose =  // without the method's name: equal values get equal verdicts
      fmt::format("gate/{}/{}/{}", move.identity.scenario, move.identity.condition, move.identity.metric);
  if (move.differing == 0) return move;  // usually, all values are equal, and no test is needed
  if (columns.weights_before != nullptr) Weigh(values, weights);
  move.comparison = ComparePaired(values, metric, seed, purpose);
  move.comparison.not_alike = columns.not_alike;
  if (move.lost + move.gained > 0) {
    move.presence = ComparePaired(presence, *FindGateMetric(kOkShare), seed, purpose + "/presence");
  }
  return move;
}

void JudgeMoves(std::span<MetricMove> moves, const std::set<std::string>& exact) {
  CorrectTogether(moves);
  for (MetricMove& move : moves) {
    if (move.differing == 0) {
      move.movement = Movement::kSame;
    } else if (exact.contains(move.identity.scenario)) {
      move.movement = Movement::kChanged;
    } else {
      JudgeByThreshold(move);
    }
  }
}

std::vector<TailWorld> FindTail(const MoveColumns& columns, const MetricInfo& metric, const TailRule& rule) {
  struct Found {
    double worse;
    TailWorld world;
  };
  std::vector<Found> found;
  for (std::size_t t = 0; t < columns.compared.size(); ++t) {
    if (!columns.compared[t] || columns.before[t] == columns.after[t] || !columns.before[t]) continue;
    TailWorld world{static_cast<int>(t),
                    columns.before[t],
                    columns.after[t],
                    LetterAt(columns.ended_before, t),
                    LetterAt(columns.ended_after, t),
                    !columns.after[t]};
    if (metric.id == kOkShare)
      world.lost = world.ended_before == kOk && world.ended_after != kUnsolved && *world.after == 0;
    if (!world.lost && !columns.not_alike.empty()) continue;
    const double worse =
        world.lost ? std::numeric_limits<double>::infinity() : Worse(*world.before, *world.after, metric);
    if (worse > rule.times) found.push_back({worse, world});
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &Found::worse);
  std::vector<TailWorld> tail;
  for (const Found& one : found) tail.push_back(one.world);
  return tail;
}

int WorldsThatFail(int compared, const TailRule& rule) {
  if (rule.worlds == 0) return 0;
  constexpr double kRounding = 1e-9;  // tolerance for rounding errors: 0.02 × 150 must give 3
  const int needed = std::max(rule.worlds, static_cast<int>(std::ceil(rule.share * compared - kRounding)));
  return std::min(needed, compared);  // if all of a few worlds became far worse, that is a regression
}

bool IsTailRegression(const std::vector<TailWorld>& tail, int compared, const TailRule& rule) {
  const int needed = WorldsThatFail(compared, rule);
  const auto lost = std::ranges::count(tail, true, &TailWorld::lost);
  return (needed > 0 && std::ssize(tail) >= needed) || (rule.lost > 0 && lost >= rule.lost);
}

void JudgeTail(MetricMove& move, const TailRule& rule) {
  const bool has_lost = std::ranges::any_of(move.tail, &TailWorld::lost);
  move.is_tail_judged = rule.worlds > 0 || (rule.lost > 0 && has_lost);
  if (move.movement == Movement::kWorse || move.movement == Movement::kChanged) return;
  if (!IsTailRegression(move.tail, move.worlds, rule)) return;
  move.movement = Movement::kWorse;
  move.by_tail = true;
}

}  // namespace etude
