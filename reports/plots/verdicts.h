#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/statistics/curves/curves.h"

namespace etude {

struct JudgedPerformance {
  int person = 0;    ///< number of the trial, because each trial has a person of its own
  double score = 0;  ///< the method's score; higher means more likely right
  double truth = 0;  ///< ground truth: 1 right, ½ grey, 0 wrong
  bool is_called = false;
  double severity = 0;      ///< severity of the performance's worst fault, 0…1; 0 without faults
  std::string fault = {};   ///< name of the worst fault; "" if there is none
  std::string danced = {};  ///< the move that was performed
  /// The move that the method recognised; "" if the method recognised no move; nullopt if the method never names moves.
  std::optional<std::string> named = {};
};

/// The verdicts of one method on all performances under one condition.
struct MethodVerdicts {
  std::vector<JudgedPerformance> performances;
  std::vector<Wait> waits;  ///< time from the start of each right performance until the verdict "right"
};

/// Returns each method's verdicts under one condition, in the scenario's order. Methods that judged no performance are
/// left out. The verdicts are read from the cells' series (`performance_…`).
std::map<std::size_t, MethodVerdicts> VerdictsUnder(const RunData& run, const ScenarioSummary& scenario,
                                                    const ConditionSummary& condition);

/// A confusion matrix: counts performances by the move that was danced and the move that the method named. "" stands
/// for no move.
struct MoveConfusion {
  std::vector<std::string> moves;                             ///< all moves that were danced or named, sorted
  std::map<std::pair<std::string, std::string>, int> counts;  ///< number of performances, by (danced, named)

  int Danced(const std::string& move) const;
};
MoveConfusion ConfusionOf(std::span<const JudgedPerformance> performances);

/// The number of faulty performances, and how many of them were found, that is, not called right.
struct FaultCount {
  int all = 0, found = 0;
};
/// Groups faulty performances by the name of their worst fault. Returns two counts per fault: performances with a
/// slight fault (severity up to ½), and performances with a more severe one.
std::map<std::string, std::pair<FaultCount, FaultCount>> FoundByFault(std::span<const JudgedPerformance> performances);

/// The number of mistakes in a person's session: right performances that were not called right, and wrong performances
/// that were called right.
struct SessionMistakes {
  int person = 0, right = 0, missed = 0, wrong = 0, praised = 0;

  double Share() const { return static_cast<double>(missed + praised) / (right + wrong); }
};
/// Returns the sessions in which the method made mistakes; the session with the largest share of mistakes comes first.
std::vector<SessionMistakes> WorstSessions(std::span<const JudgedPerformance> performances);

/// Returns tables for each condition: the faults that each method found, the sessions in which the method in question
/// made most mistakes, and the confused moves. Returns "" if methods judge no performances.
std::string VerdictTablesHtml(const RunData& run, const ScenarioSummary& scenario);

/// Returns the share of faulty performances that a method found (did not call right) for each fifth of the severity
/// range, as (centre of the fifth, share). Fifths without performances are left out.
std::vector<std::pair<double, double>> FoundBySeverity(std::span<const JudgedPerformance> performances);

/// Returns the severity at which the share of found faults first reaches ½, by linear interpolation; nullopt if the
/// share never reaches ½.
std::optional<double> HalfFoundAt(std::span<const std::pair<double, double>> curve);

/// Returns plots of the methods' verdicts, per condition: every method's ROC curve with the area under it, its
/// detection error tradeoff (DET) curve, the share of found faults over severity, and the waiting times for the verdict
/// "right". Returns "" if methods judge no performances.
std::string VerdictCurvesHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
