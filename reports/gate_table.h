#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/gate/gate.h"
#include "reports/words/figures.h"

namespace etude {

/// A metric's change since the baseline, in words.
struct GateTableRow {
  std::string scenario, condition, method, metric;
  std::string before, after;  ///< the metric's aggregate over all worlds: in the baseline, and in this run
  std::string difference;     ///< median (or mean) of the paired differences, now − baseline, and its interval
  std::string p;              ///< p-value after Holm's correction; kNoValue if nothing was tested
  std::string worlds;         ///< number of worlds whose values differ, "12 of 60", then the numbers of lost values,
                              ///< gained values and far worse worlds that are above 0
  std::string verdict;        ///< text of MovementWords, or "worse in 5 worlds" if the far worse worlds decided
  bool fails = false;
};

/// Returns one row per metric that changed (any movement but kSame). Regressions come first; within each group, rows
/// have the order of the run.
std::vector<GateTableRow> MovedRows(const SnapshotComparison& comparison);
GateTableRow GateRowOf(const MetricMove& move);

/// Returns a claim about processor times as text: "processor time of fixed over …".
std::string RatioClaim(const RatioResult& ratio);
std::string RatioDetail(const RatioResult& ratio);

/// Returns the name of a verdict: "pass", "regression", "incomplete".
std::string_view GateVerdictWords(GateVerdict verdict);
/// Returns one sentence for each kind of check of the gate: "12 expectations: 11 met, 1 unmet", "against the baseline,
/// 170 comparisons: 2 worse, 168 same".
std::vector<std::string> GateSentences(const GateReport& report);
/// Returns one line for each answer whose verdict became worse since the baseline. If `only_reversed` is true, returns
/// only the answers that changed from better to worse, which fail the gate.
std::vector<std::string> WorsenedLines(const GateReport& report, bool only_reversed = false);
/// Returns one line for each method and reason why values cannot be compared: "evaluate, -, mine: not judged alike: …",
/// with the metrics. These changes are undecided.
std::vector<std::string> NotAlikeLines(const SnapshotComparison& comparison);
/// Returns the number of metrics with each outcome: "170 comparisons: 2 worse, 3 better, 165 same".
std::string CompareSentence(const SnapshotComparison& comparison);

/// Returns the identity (Row::Id) of a cell: "ik-weights/joint_noise_deg=5/007/fixed".
std::string CellOf(const MoveIdentity& identity, int trial);
/// Returns a command for a shell that runs a cell again, and compares it with the baseline of the gate.
std::string ReplayCommand(const GateReport& report, const std::string& cell);

/// A line of text about a world that is far worse than in the baseline.
struct TailLine {
  std::string
      world;  ///< "ik-weights, joint_noise_deg=5, trial 7, fixed: ok → unsolved; orientation error 0.05° → 60.1°"
  std::string replay;  ///< command "etude replay out/now --cell …" for a shell; "" for the line that counts the rest
};

/// Returns one line for each of the first `most` far worse worlds of one method under one condition. `moves` are the
/// changes of that method's metrics. Worlds that no longer have an answer come first, then the worst world of each
/// metric. A last line counts the worlds that were left out.
std::vector<TailLine> TailLines(const std::vector<const MetricMove*>& moves, const GateReport& report,
                                std::size_t most);

/// The effect of far worse worlds on the gate's verdict.
enum class TailGroup {
  kFailing,    ///< their metric fails the gate
  kTooFew,     ///< the tail rule judged them: too few to fail
  kNotJudged,  ///< the scenario turned the tail rule off
};
/// Returns the heading of a list of these worlds.
std::string_view TailHeading(TailGroup group);
/// Returns lines about the worlds of a group. Each method has at most `most_each` worlds, and there are about `most`
/// lines in total.
std::vector<TailLine> TailLines(const GateReport& report, TailGroup group, std::size_t most_each, std::size_t most);

/// Returns the results of a gate as a comment on a pull request: the verdict, the failures, other changes, and the
/// entries that could not be compared.
std::string WriteGateMarkdown(const GateReport& report);

/// Returns the results of a gate as JUnit XML: one suite per scenario, with one case per expectation, time rule and
/// comparison. An incomplete run fails a case of the suite "gate".
std::string WriteGateJunit(const GateReport& report);

}  // namespace etude
