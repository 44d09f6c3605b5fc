#pragma once

#include <string>
#include <vector>

#include "bench/gate/gate.h"
#include "reports/words/figures.h"

namespace etude {

/// A metric's change since the baseline, in words.
struct GateTableRow {
  std::string scenario, condition, method, metric;
  std::string before, after;  ///< the metric's aggregate over all worlds
  std::string difference;     ///< the median (or mean) of the paired differences, with its interval
  std::string p;              ///< p-value after Holm's correction; kNoValue if nothing was tested
  std::string worlds;         ///< "12 of 60", with the numbers of lost values, gained values and far worse worlds
  std::string verdict;        ///< MovementWords; "worse in 5 worlds" if the tail rule decided
  bool fails = false;
};

/// Returns one row per move that is not kSame: regressions first, each group in the order of the run.
std::vector<GateTableRow> MovedRows(const SnapshotComparison& comparison);
GateTableRow GateRowOf(const MetricMove& move);

/// Returns the text of a time rule: "processor time of fixed over …".
std::string RatioClaim(const RatioResult& ratio);
std::string RatioDetail(const RatioResult& ratio);

/// Returns the name of a verdict: "pass", "regression", "incomplete".
std::string_view GateVerdictWords(GateVerdict verdict);
/// Returns one sentence for each kind of judgement: "12 expectations: 11 met, 1 unmet", "against the baseline, 170
/// comparisons: 2 worse, 168 same".
std::vector<std::string> GateSentences(const GateReport& report);
/// Returns one line for each answer that became worse since the baseline; if `only_flipped`, only for the answers that
/// fail the gate.
std::vector<std::string> FallenLines(const GateReport& report, bool only_flipped = false);
/// Returns the counts of the moves: "170 comparisons: 2 worse, 3 better, 165 same".
std::string CompareSentence(const SnapshotComparison& comparison);

/// A far worse world, in words.
struct TailLine {
  std::string
      world;  ///< "ik-weights, joint_noise_deg=5, trial 7, fixed: ok → unsolved; orientation error 0.05° → 60.1°"
  std::string replay;  ///< "etude replay out/now --cell …", quoted for a shell; "" for the line that counts the rest
};

/// Returns one line for each of the first `most` far worse worlds of one method under one condition; `moves` are the
/// movements of that method's metrics. Worlds that lost their answer come first, then the worst world of each metric. A
/// last line counts the rest.
std::vector<TailLine> TailLines(const std::vector<const MetricMove*>& moves, const GateReport& report,
                                std::size_t most);

/// Returns the lines of far worse worlds for all movements that fail the gate (`failing`), or for all others: at most
/// `most_each` worlds of a method, and about `most` lines in total.
std::vector<TailLine> TailLines(const GateReport& report, bool failing, std::size_t most_each, std::size_t most);

/// Returns the findings of a gate as a comment on a pull request: the verdict, the failures, other changes, and what
/// could not be compared.
std::string WriteGateMarkdown(const GateReport& report);

/// Returns the findings of a gate as JUnit XML: one suite per scenario, with one case per expectation, time rule and
/// comparison. An incomplete run fails a case of the suite "gate".
std::string WriteGateJunit(const GateReport& report);

}  // namespace etude
