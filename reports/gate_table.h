#pragma once

#include <string>
#include <vector>

#include "bench/gate/gate.h"
#include "reports/words/figures.h"

namespace etude {

/// One line of "what moved", in words.
struct GateTableRow {
  std::string scenario, condition, method, metric;
  std::string before, after;  ///< the metric's aggregate over all worlds
  std::string difference;     ///< of the pairs, with its interval
  std::string p;              ///< of the test, after Holm's correction; kNoValue when nothing was tested
  std::string worlds;         ///< "12 of 60", lost and gained values and far worse worlds told
  std::string verdict;        ///< MovementWords; "worse in 5 worlds" where the tail rule has decided
  bool fails = false;
};

/// Gives one row per move that is not kSame: regressions first, each group in the order of the run.
std::vector<GateTableRow> MovedRows(const SnapshotComparison& comparison);
GateTableRow GateRowOf(const MetricMove& move);

/// Writes how a time rule reads: "processor time of fixed over …".
std::string RatioClaim(const RatioResult& ratio);
std::string RatioDetail(const RatioResult& ratio);

/// Names a verdict: "pass", "regression", "incomplete".
std::string_view GateVerdictWords(GateVerdict verdict);
/// Writes what was judged, a sentence each: "12 expectations: 11 met, 1 unmet", "against the baseline, 170 comparisons:
/// 2 worse, 168 same".
std::vector<std::string> GateSentences(const GateReport& report);
/// Counts the moves: "170 comparisons: 2 worse, 3 better, 165 same".
std::string CompareSentence(const SnapshotComparison& comparison);

/// A world that is far worse, in words.
struct TailLine {
  std::string
      world;  ///< "ik-weights, joint_noise_deg=5, trial 7, fixed: ok → unsolved; orientation error 0.05° → 60.1°"
  std::string replay;  ///< "etude replay out/now --cell …", fit for a shell; "" for a line that only counts the rest
};

/// Writes one line for each of the first `most` far worse worlds of one method under one condition, whose `moves` these
/// are: worlds that lost their answer first, then the worst of each metric. A last line counts the others.
std::vector<TailLine> TailLines(const std::vector<const MetricMove*>& moves, const GateReport& report,
                                std::size_t most);

/// Writes the lines of the moves that fail, or of those that do not: `most_each` worlds of a method and about `most`
/// lines in all.
std::vector<TailLine> TailLines(const GateReport& report, bool failing, std::size_t most_each, std::size_t most);

/// Writes what a gate found as a comment on a pull request: the verdict, what fails, what else moved, what could not be
/// compared.
std::string WriteGateMarkdown(const GateReport& report);

/// Writes the same as JUnit XML: a suite per scenario, in it a case per expectation, time rule and comparison; an
/// incomplete run fails a case of the suite "gate".
std::string WriteGateJunit(const GateReport& report);

}  // namespace etude
