#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/model/summary.h"

namespace etude {

/// Whom a method is compared with: the one its scenario names, or the strongest other one.
enum class Against { kBaseline, kRival };

/// A comparison and the condition that it was made under.
struct Judged {
  const Comparison* comparison;
  const ConditionSummary* condition;
};

/// The comparisons of `method` by `metric`, one per condition, in their order. Of runs that were summed up before
/// rivals were, there is none with a rival.
std::vector<Judged> JudgedOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// The methods that a comparison's baseline names: itself, or of a rival "a or b" both (bench/statistics/scenario_table.h).
std::vector<std::string> BaselinesOf(const Judged& judged);

/// "“a”", or where conditions or halves of the worlds have other rivals "“a” or “b”"
std::string OthersOf(const std::vector<Judged>& judged);

/// The verdict on these worlds that all of them agree in; nothing when they differ. `judged` must not be empty.
std::optional<Verdict> CommonVerdict(const std::vector<Judged>& judged);

/// "both conditions", "all 4 conditions"
std::string AllConditions(std::size_t count);

/// "better under 3 of 4, inconclusive under 1 of 4", "worse under all 4 conditions"; "" without verdicts.
std::string CountVerdicts(const std::vector<Verdict>& verdicts, std::size_t conditions);

/// Their verdicts on these worlds.
std::vector<Verdict> VerdictsOf(const std::vector<Judged>& judged);

}  // namespace etude
