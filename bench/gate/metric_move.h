#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/model/study.h"
#include "bench/model/summary.h"

namespace etude {

/// The id of a pseudo-metric: 1 in every world whose cell ended with status ok, else 0.
constexpr const char* kOkShare = "ok_share";

/// Returns the catalogue's definition of a metric, or the gate's own definition of kOkShare; null if the id is unknown.
const MetricInfo* FindGateMetric(std::string_view id);

enum class Movement {
  kSame,      ///< all values are equal
  kBetter,    ///< clearly better, by at least the practical threshold
  kWorse,     ///< clearly worse, by at least the practical threshold
  kNoMatter,  ///< the difference is clearly below the practical threshold
  kUnclear,   ///< values differ, but no other verdict is clear; or the metric has no direction
  kChanged,   ///< values differ in a scenario whose rule is `exact`
};
/// Returns "same", "better", "worse", "too small to matter", "unclear" or "changed".
std::string_view MovementWords(Movement movement);

struct MoveIdentity {
  std::string scenario, condition, method, metric;
};

/// A world that is far worse than before (TailRule).
struct TailWorld {
  int trial = 0;
  std::optional<double> before, after;         ///< nullopt = the cell has no value
  char ended_before = 'o', ended_after = 'o';  ///< status letter of the cell in each snapshot (StatusLetter)
  bool lost = false;                           ///< true: the cell had a value or an answer before, and has none now
};

/// The change of one metric of one method under one condition, between two snapshots.
struct MetricMove {
  MoveIdentity identity;
  Movement movement = Movement::kSame;
  int worlds = 0;                       ///< worlds with no cell that timed out, crashed or ran out of memory
  int differing = 0;                    ///< worlds among these whose values differ, were lost or were gained
  int lost = 0;                         ///< values that the second snapshot does not have
  int gained = 0;                       ///< values that the first snapshot does not have
  std::optional<double> before, after;  ///< the metric's aggregate over the present values
  Comparison comparison;                ///< the comparison over worlds with both values; later − earlier
  /// True if the verdict comes from the difference of means; false if it comes from the metric's own aggregate.
  bool by_mean = false;
  std::optional<Comparison> presence;  ///< if values were lost or gained: the comparison of "has a value" (1 or 0)
  std::vector<TailWorld> tail;         ///< lost worlds first, then the worst
  bool by_tail = false;                ///< true: the tail rule decided, and the other rules would have passed
};

/// The values before and after, and whether each trial is compared. All members are indexed by trial and have the same
/// length.
struct MoveColumns {
  std::vector<std::optional<double>> before, after;
  std::vector<bool> compared;
  std::string ended_before, ended_after;  ///< letters of StatusLetter, by trial; used by the tail rule only
};

/// Compares two columns world by world. `movement` stays kSame until JudgeMoves sets it. `seed` keys the random
/// streams.
MetricMove MeasureMove(MoveIdentity identity, const MoveColumns& columns, std::uint64_t seed);

/// Judges each move. In a scenario that `exact` names, any difference is kChanged. In other scenarios, three
/// comparisons are judged: the metric's own aggregate; the mean, because a median does not show a change in fewer than
/// half of the worlds; and the share of worlds with a value. If one of the three is worse, the move is worse. Holm's
/// correction covers all comparisons of `moves` in which a world differs.
///
/// The correction stays valid although comparisons without a difference are left out: the tests flip the signs of the
/// differences, and whether there is a difference does not depend on signs.
void JudgeMoves(std::span<MetricMove> moves, const std::set<std::string>& exact);

/// The tail rules of scenarios, by name; scenarios not listed have the default.
using TailRules = std::map<std::string, TailRule>;

/// Returns the worlds that became far worse: by more than `rule.times` practical thresholds, or because their value was
/// lost. For kOkShare, a world is far worse if it was `ok` and no longer is; it counts as lost unless it is now
/// `unsolved`. If the metric has no direction, only lost values count. Lost worlds come first, then the others from the
/// worst on.
std::vector<TailWorld> FindTail(const MoveColumns& columns, const MetricInfo& metric, const TailRule& rule);

/// Returns the smallest number of far worse worlds, among `compared` worlds, that counts as a regression; 0 = no number
/// does.
int WorldsThatFail(int compared, const TailRule& rule);
bool IsTailRegression(const std::vector<TailWorld>& tail, int compared, const TailRule& rule);

/// Sets `move.movement` to kWorse if the move's tail is a regression, unless it is already kWorse or kChanged.
void JudgeTail(MetricMove& move, const TailRule& rule);

}  // namespace etude
