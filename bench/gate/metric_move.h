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

/// The id of a metric that the gate itself defines: 1 in every world whose cell ended with status ok, else 0.
constexpr const char* kOkShare = "ok_share";

/// Returns the catalogue's definition of a metric, or the gate's own definition of kOkShare; null if the id is unknown.
const MetricInfo* FindGateMetric(std::string_view id);

enum class Movement {
  kSame,       ///< all values are the same in both snapshots
  kBetter,     ///< the value is better: the difference is significant and at least the practical threshold
  kWorse,      ///< the value is worse: the difference is significant and at least the practical threshold
  kNoMatter,   ///< the whole interval of the difference lies within ± the practical threshold
  kUndecided,  ///< values differ, but the test supports none of the results above; or the metric has no direction
  kChanged,    ///< values differ in a scenario whose gate rule is `exact`
};
/// Returns "same", "better", "worse", "too small to matter", "undecided" or "changed".
std::string_view MovementWords(Movement movement);

struct MoveIdentity {
  std::string scenario, condition, method, metric;
};

/// A world whose value became far worse between two snapshots (TailRule).
struct TailWorld {
  int trial = 0;
  std::optional<double> before, after;         ///< the metric's value in each snapshot; nullopt if the cell has none
  char ended_before = 'o', ended_after = 'o';  ///< status letter of the cell in each snapshot (StatusLetter)
  bool lost = false;                           ///< true: the cell had a value or an answer before, and has none now
};

/// The change of one metric of one method under one condition, between two snapshots.
struct MetricMove {
  MoveIdentity identity;
  Movement movement = Movement::kSame;
  int worlds = 0;     ///< number of worlds in which no cell timed out, crashed or ran out of memory
  int differing = 0;  ///< number of compared worlds in which the value differs, or exists in one snapshot only
  int lost = 0;       ///< number of worlds with a value in the first snapshot only
  int gained = 0;     ///< number of worlds with a value in the second snapshot only
  std::optional<double> before, after;  ///< the metric's aggregate over the values in each snapshot
  Comparison comparison;  ///< paired comparison, later − earlier, of the worlds with a value in both snapshots
  /// True if the means decided about the values, not the metric's own aggregate. `presence` and the tail rule may
  /// change `movement` afterwards.
  bool by_mean = false;
  std::optional<Comparison> presence;  ///< comparison of "has a value" (1 or 0), if values were lost or gained
  /// Far worse worlds: first those that lost their value, then the others, the worst first.
  std::vector<TailWorld> tail;
  /// True if the tail rule judged the worlds of `tail`; false if the rule is off, at least for these worlds.
  bool is_tail_judged = false;
  bool by_tail = false;  ///< true: only the tail rule makes this change a regression
};

/// The values of one metric in both snapshots, and whether each trial is compared. All members are indexed by trial and
/// have the same length.
struct MoveColumns {
  std::vector<std::optional<double>> before, after;
  /// The worlds' weights in each snapshot (MetricInfo::weight); null: every world counts alike. A world without a
  /// weight weighs 0.
  const std::vector<std::optional<double>>* weights_before = nullptr;
  const std::vector<std::optional<double>>* weights_after = nullptr;
  std::vector<bool> compared;
  /// The cell's status in each snapshot (StatusLetter), by trial; only the tail rule needs it.
  std::string ended_before, ended_after;
  std::string not_alike = {};  ///< why the values of the two snapshots cannot be compared (WhyNotAlike); "" = they can
};

/// Compares the values of two snapshots world by world. `movement` of the result stays kSame until JudgeMoves sets it.
/// With weights, MetricMove::before and ::after are the means that each snapshot's own summary shows; the comparison
/// of pairs weighs both values of a world by the earlier weight.
/// If the columns are not alike, the change of the values is kUndecided, and only lost values count as far worse.
/// `seed` seeds the random numbers of the bootstrap and of the tests.
MetricMove MeasureMove(MoveIdentity identity, const MoveColumns& columns, std::uint64_t seed);

/// Judges each change of a metric (move). In a scenario that `exact` names, any difference is kChanged. In other
/// scenarios, three comparisons are judged: the metric's own aggregate; the mean, because a median does not show a
/// change in fewer than half of the worlds; and the share of worlds with a value. If one of the three is worse, the
/// change is kWorse. Holm's correction covers all comparisons of `moves` in which a world differs.
///
/// The correction stays valid although comparisons without a difference are left out: the tests flip the signs of the
/// differences, and whether there is a difference does not depend on signs.
void JudgeMoves(std::span<MetricMove> moves, const std::set<std::string>& exact);

/// The tail rules of scenarios, by name; scenarios not listed have the default.
using TailRules = std::map<std::string, TailRule>;

/// Returns the worlds that became far worse: by more than `rule.times` practical thresholds, or because their value was
/// lost. For kOkShare, a world is far worse if it was `ok` and no longer is; the world counts as lost unless it is now
/// `unsolved`. If the metric has no direction, only lost values count. Lost worlds come first, then the others, the
/// worst first.
std::vector<TailWorld> FindTail(const MoveColumns& columns, const MetricInfo& metric, const TailRule& rule);

/// Returns the smallest number of far worse worlds, among `compared` worlds, that counts as a regression; 0 if no
/// number does. It is at most `compared`.
int WorldsThatFail(int compared, const TailRule& rule);
bool IsTailRegression(const std::vector<TailWorld>& tail, int compared, const TailRule& rule);

/// Sets `move.is_tail_judged`, and sets `move.movement` to kWorse if the far worse worlds of the metric are a
/// regression, unless `movement` is already kWorse or kChanged.
void JudgeTail(MetricMove& move, const TailRule& rule);

}  // namespace etude
