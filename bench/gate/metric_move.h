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

/// The pseudo-metric "did the cell end ok?": 1 or 0 in every world.
constexpr const char* kOkShare = "ok_share";

/// Returns the catalogue's entry of a metric, or our own of kOkShare; null if there is no such metric.
const MetricInfo* FindGateMetric(std::string_view id);

/// The change of a metric from one snapshot to another.
enum class Movement {
  kSame,      ///< no digit differs
  kBetter,    ///< clearly, and by at least the practical threshold
  kWorse,     ///< clearly, and by at least the practical threshold
  kNoMatter,  ///< clearly by less than the practical threshold
  kUnclear,   ///< it differs, but the worlds do not decide the direction or size; or the metric has no direction
  kChanged,   ///< it differs in a scenario whose rule is `exact`
};
/// "same", "better", "worse", "too small to matter", "unclear", "changed"
std::string_view MovementWords(Movement movement);

/// Identifies the values that moved.
struct MoveIdentity {
  std::string scenario, condition, method, metric;
};

/// A world that is far worse than before (TailRule).
struct TailWorld {
  int trial = 0;
  std::optional<double> before, after;         ///< nothing = no value
  char ended_before = 'o', ended_after = 'o';  ///< StatusLetter
  bool lost = false;                           ///< it has no value or no answer any more
};

/// One metric of one method under one condition, in two snapshots.
struct MetricMove {
  MoveIdentity identity;
  Movement movement = Movement::kSame;
  int worlds = 0;                       ///< worlds in which neither cell was ended by the machine
  int differing = 0;                    ///< of these, worlds with different values, lost and gained ones included
  int lost = 0;                         ///< values that became null
  int gained = 0;                       ///< nulls that became values
  std::optional<double> before, after;  ///< the metric's aggregate over the present values
  Comparison comparison;                ///< over worlds with both values; later − earlier
  bool by_mean = false;                 ///< the mean decided: few worlds differ, but by much
  std::optional<Comparison> presence;   ///< if values were lost or gained: the comparison of "has a value", 1 or 0
  std::vector<TailWorld> tail;          ///< lost worlds first, then the worst
  bool by_tail = false;                 ///< the tail rule decided: all worlds together would have passed
};

/// The values of the same trials before and after, and which of them are compared. All have the same length.
struct MoveColumns {
  std::vector<std::optional<double>> before, after;
  std::vector<bool> compared;
  std::string ended_before, ended_after;  ///< StatusLetter by trial; used by the tail rule only
};

/// Compares world by world; JudgeMoves gives the verdict later. `seed` keys the random streams.
MetricMove MeasureMove(MoveIdentity identity, const MoveColumns& columns, std::uint64_t seed);

/// Judges each move. In a scenario of `exact` any difference is kChanged. In others the test's p is corrected (Holm)
/// over all comparisons of `moves` that differ at all, and three comparisons are judged: the metric's own aggregate;
/// the mean, because a median does not show changes in fewer than half of the worlds, and a change of code often
/// affects only a few; and the share of worlds that have a value. If one of them is worse, the move is worse.
///
/// Leaving out comparisons without any difference does not invalidate the correction: the tests flip the signs of the
/// existing differences, and whether there are any does not depend on signs.
void JudgeMoves(std::span<MetricMove> moves, const std::set<std::string>& exact);

/// The tail rules of scenarios, by name; scenarios not listed have the default.
using TailRules = std::map<std::string, TailRule>;

/// Returns the worlds that are worse by more than `rule.times` practical thresholds, or have lost something: of a
/// metric, its value; of kOkShare, an `ok` that is not `ok` any more, which counts as lost if there is no answer at all
/// (`unsolved` is an answer). Without a better direction only lost values count. Lost worlds come first, then the
/// worst.
std::vector<TailWorld> FindTail(const MoveColumns& columns, const MetricInfo& metric, const TailRule& rule);

/// Returns the number of far worse worlds among `compared` that is a regression; 0 = never.
int WorldsThatFail(int compared, const TailRule& rule);
/// Returns true if these worlds are a regression among `compared`.
bool IsTailRegression(const std::vector<TailWorld>& tail, int compared, const TailRule& rule);

/// Sets a move to kWorse if its tail is a regression and it is not worse already. A move judged by the rule `exact`
/// (kChanged) stays.
void JudgeTail(MetricMove& move, const TailRule& rule);

}  // namespace etude
