#include "bench/gate/tail_rule.h"

#include <algorithm>
#include <limits>

namespace etude {
namespace {

constexpr char kOk = 'o', kUnsolved = 'u';

/// How much worse a world is, in practical thresholds; negative = better.
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
    const double worse =
        world.lost ? std::numeric_limits<double>::infinity() : Worse(*world.before, *world.after, metric);
    if (worse > rule.times) found.push_back({worse, world});
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &Found::worse);
  std::vector<TailWorld> tail;
  for (const Found& one : found) tail.push_back(one.world);
  return tail;
}

bool IsTailRegression(const std::vector<TailWorld>& tail, const TailRule& rule) {
  const auto lost = std::ranges::count(tail, true, &TailWorld::lost);
  return (rule.worlds > 0 && std::ssize(tail) >= rule.worlds) || (rule.lost > 0 && lost >= rule.lost);
}

void JudgeTail(MetricMove& move, const TailRule& rule) {
  if (move.movement == Movement::kWorse || move.movement == Movement::kChanged) return;
  if (!IsTailRegression(move.tail, rule)) return;
  move.movement = Movement::kWorse;
  move.by_tail = true;
}

}  // namespace etude
