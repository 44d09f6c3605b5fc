#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/gate/metric_move.h"
#include "bench/model/study.h"

namespace etude {

/// The tail rules of scenarios, by name; one that is not there has the default.
using TailRules = std::map<std::string, TailRule>;

/// The worlds that are worse by more than `rule.times` practical thresholds, or have lost something: of a metric, its
/// value; of kOkShare, an `ok` that is `ok` no more, which is lost when there is no answer at all (`unsolved` is one).
/// Without a better direction, no value is worse than another, but lost ones are. Lost worlds first, then the worst.
std::vector<TailWorld> FindTail(const MoveColumns& columns, const MetricInfo& metric, const TailRule& rule);

/// How many far worse worlds of so many compared ones are a regression; 0 = none ever is.
int WorldsThatFail(int compared, const TailRule& rule);
/// Whether these are, of so many compared.
bool IsTailRegression(const std::vector<TailWorld>& tail, int compared, const TailRule& rule);

/// Makes kWorse of moves whose tail is a regression and that all worlds together do not call worse already. What is
/// judged by the rule `exact` (kChanged) stays.
void JudgeTail(MetricMove& move, const TailRule& rule);

}  // namespace etude
