#include "bench/gate/tail_rule.h"

#include <algorithm>
#include <cmath>
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

int WorldsThatFail(int compared, const TailRule& rule) {
  if (rule.worlds == 0) return 0;
  constexpr double kRounding = 1e-9;  // 0.02 of 150 is 3, whatever the product's last bit
  return std::max(rule.worlds, static_cast<int>(std::ceil(rule.share * compared - kRounding)));
}

bool IsTailRegression(const std::vector<TailWorld>& tail, int compared, const TailRule& rule) {
  const int needed = WorldsThatFail(compared, rule);
  const auto lost = std::ranges::count(tail, true, &TailWorld::lost);
  return (needed > 0 && std::ssize(tail) >= needed) || (rule.lost > 0 && lost >= rule.lost);
}

void JudgeTail(MetricMove& move, const TailRule& rule) {
  if (move.movement == Movement::kWorse || move.movement == Movement::kChanged) return;
  if (!IsTailRegression(move.tail, move.worlds, rule)) return;
  move.movement = Movement::kWorse;
  move.by_tail = true;
}

}  // namespace etude
