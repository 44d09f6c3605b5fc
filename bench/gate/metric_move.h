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

/// The pseudo-metric "did the cell end ok?" of a comparison: 1 or 0 in every world.
constexpr const char* kOkShare = "ok_share";

/// The catalogue's entry of a metric, or ours of kOkShare. Null when there is no such metric.
const MetricInfo* FindGateMetric(std::string_view id);

/// The change of a metric from one snapshot to another.
enum class Movement {
  kSame,      ///< not a digit
  kBetter,    ///< clearly, and by as much as matters
  kWorse,     ///< clearly, and by as much as matters
  kNoMatter,  ///< clearly by less than matters
  kUnclear,   ///< it differs, and the worlds do not settle what that means; or the metric has no direction
  kChanged,   ///< it differs, under the rule that nothing may
};
/// "same", "better", "worse", "too small to matter", "unclear", "changed"
std::string_view MovementWords(Movement movement);

/// Names the numbers that moved.
struct MoveIdentity {
  std::string scenario, condition, method, metric;
};

/// A world that came out far worse than before (tail_rule.h).
struct TailWorld {
  int trial = 0;
  std::optional<double> before, after;         ///< nothing = no value
  char ended_before = 'o', ended_after = 'o';  ///< StatusLetter
  bool lost = false;                           ///< its value, or its answer, is gone
};

/// One metric of one method under one condition, in two snapshots.
struct MetricMove {
  MoveIdentity identity;
  Movement movement = Movement::kSame;
  int worlds = 0;                       ///< in which both cells ended for reasons of their own
  int differing = 0;                    ///< of these, where the two are not the same, lost and gained values included
  int lost = 0;                         ///< values that became null
  int gained = 0;                       ///< nulls that became values
  std::optional<double> before, after;  ///< the metric's aggregate over the values there are
  Comparison comparison;                ///< where both have a value; later − earlier
  bool by_mean = false;                 ///< the mean has decided: few worlds differ, but much
  std::optional<Comparison> presence;   ///< where values were lost or gained: of "has a value", 1 or 0
  std::vector<TailWorld> tail;          ///< the worst first, lost ones before all others
  bool by_tail = false;                 ///< the tail rule has decided: all worlds together would not have failed
};

/// The values of the same trials before and after; `compared` says which of them count. All of one length.
struct MoveColumns {
  std::vector<std::optional<double>> before, after;
  std::vector<bool> compared;
  std::string ended_before, ended_after;  ///< StatusLetter by trial; for the tail rule only
};

/// Compares world by world; the verdict is left to JudgeMoves. `seed` keys the dice.
MetricMove MeasureMove(MoveIdentity identity, const MoveColumns& columns, std::uint64_t seed);

/// Judges each move. In a scenario of `exact` any difference is kChanged. Else it takes the test's p
/// after Holm's correction over all comparisons of `moves` that differ at all, and three questions: the metric's own
/// aggregate; the mean, because a median does not see what happens in fewer than half of the worlds, and a change of
/// code often touches no more; and the share of worlds that have a value. Worse in one of them is worse.
///
/// Leaving out what does not differ costs no validity: the tests flip the signs of the differences that there are,
/// and whether there are any does not depend on signs.
void JudgeMoves(std::span<MetricMove> moves, const std::set<std::string>& exact);

/// The tail rules of scenarios, by name; one that is not there has the default.
using TailRules = std::map<std::string, TailRule>;

/// The worlds that are worse by more than `rule.times` practical thresholds, or have lost something: of a metric, its
/// value; of kOkShare, an `ok` that is `ok` no more, which is lost when there is no answer at all (`unsolved` is one).
/// Without a better direction, no value is worse than another, but lost ones are. Lost worlds first, then the worst.
std::vector<TailWorld> FindTail(const MoveColumns& columns, const MetricInfo& metric, const TailRule& rule);

/// The number of far worse worlds, of so many compared ones, that is a regression; 0 = none ever is.
int WorldsThatFail(int compared, const TailRule& rule);
/// True if these are a regression, of so many compared.
bool IsTailRegression(const std::vector<TailWorld>& tail, int compared, const TailRule& rule);

/// Makes kWorse of moves whose tail is a regression and that all worlds together do not call worse already. What is
/// judged by the rule `exact` (kChanged) stays.
void JudgeTail(MetricMove& move, const TailRule& rule);

}  // namespace etude
