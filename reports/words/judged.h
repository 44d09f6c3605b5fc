#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/summary.h"

namespace etude {

/// The other side of a comparison: the method that the scenario names, or the strongest other one.
enum class Against { kBaseline, kRival };

/// A comparison and the condition that it was made under.
struct Judged {
  const Comparison* comparison;
  const ConditionSummary* condition;
};

/// Gives the comparisons of `method` by `metric`, one per condition, in their order. Runs that were summed up before
/// rivals were compared have none with a rival.
std::vector<Judged> JudgedOf(const ScenarioSummary& scenario, const std::string& method, const std::string& metric,
                             Against against);

/// Gives the methods that a comparison's baseline names: itself, or of a rival "a or b" both
/// (bench/statistics/scenario_table.h).
std::vector<std::string> BaselinesOf(const Judged& judged);

/// Names the other sides: "“a”", or where conditions or halves of the worlds have other rivals "“a” or “b”".
std::string OthersOf(const std::vector<Judged>& judged);

/// Gives the verdict on these worlds that all of them agree in; nothing when they differ. `judged` must not be empty.
std::optional<Verdict> CommonVerdict(const std::vector<Judged>& judged);

/// Writes "both conditions", "all 4 conditions".
std::string AllConditions(std::size_t count);

/// Counts verdicts: "better under 3 of 4, inconclusive under 1 of 4", "worse under all 4 conditions"; "" without
/// verdicts.
std::string CountVerdicts(const std::vector<Verdict>& verdicts, std::size_t conditions);

/// Gives their verdicts on these worlds.
std::vector<Verdict> VerdictsOf(const std::vector<Judged>& judged);

/// Is true of a method that is compared with none, as its scenario says (`against` itself). The first method is
/// everyone's baseline, and not meant.
bool IsComparedWithNone(const ScenarioSummary& scenario, const std::string& method);

/// Is true of a yardstick: a method that is compared with none and none with it, like natural motion.
bool IsYardstick(const ScenarioSummary& scenario, const std::string& method);

/// Gives the method's place among the scenario's, by which it is drawn; their number when it is none of them.
std::size_t IndexOf(const ScenarioSummary& scenario, const std::string& method);

/// Gives the method's name, a yardstick's as "natural (yardstick)".
std::string MethodLabel(const ScenarioSummary& scenario, const std::string& method);

/// Names the units of a verdict on the worlds that were run: "these worlds", "these people", "these clips".
std::string_view TheseUnits(SamplingUnit unit);
/// Names the units of a verdict beyond them: "other worlds", "other people", "other clips".
std::string_view OtherUnits(SamplingUnit unit);

/// The finding of comparisons beyond their worlds, over all conditions.
struct BeyondFinding {
  bool on_these_only = true;            ///< under no condition is there a verdict beyond these worlds
  bool as_on_these = false;             ///< under every condition there is one, the same as on these worlds
  std::optional<Verdict> verdict = {};  ///< that all conditions with a verdict agree in
  std::string words = {};               ///< "for other clips: worse", "on these clips only (4 clips, 6 are needed)"
};
BeyondFinding BeyondInWords(const std::vector<Judged>& judged, SamplingUnit unit);

/// Writes the finding of one comparison in as few words as a table's cell or an XML attribute takes.
std::string ShortBeyond(const Comparison& comparison, SamplingUnit unit);

}  // namespace etude
